#include "job/place_on_bed.hpp"

#include <algorithm>
#include <vector>

#include "gcode/layout.hpp"

namespace sillon {

namespace {

/// Settings of a layer that are lengths in mm, besides its place and size.
std::vector<double*> lengthsOf(Layer& layer) {
  std::vector<double*> lengths{&layer.soft};
  if (auto* letters = layer.as<LayerLetters>()) lengths.insert(lengths.end(), {&letters->textSize, &letters->circle});
  if (auto* pattern = layer.as<PatternLayer>()) lengths.push_back(&pattern->waveLength);
  if (auto* tones = layer.as<TonesLayer>()) lengths.push_back(&tones->smoothing);
  if (auto* border = layer.as<BorderLayer>()) lengths.push_back(&border->width);
  if (auto* strokes = layer.as<StrokesLayer>()) {
    for (Stroke& stroke : strokes->strokes) lengths.push_back(&stroke.radius);
  }
  return lengths;
}

}  // namespace

bool placeOnBed(Project& project, const Shape& shape, Placing placing) {
  if (placing == Placing::AsGiven) return false;
  const BedFit fit = fitBed(shape, project.printer, project.print);
  if (fit.centred) return false;
  if (fit.turned) {
    project.print.rotate += project.print.rotate > 270 ? -270 : 90;
    return false;
  }
  if (placing != Placing::Fit || fit.percent < 1) return false;
  const double percent = fit.percent / 100.0;
  // An outline offset stays as it is, so the shape within it shrinks by more.
  const double offset = 2 * project.outlineOffset;
  const Vec2 box = bounds(shape).size();
  const double side = std::min(box.x, box.y);
  const double scale = offset == 0 ? percent : (percent * side - offset) / (side - offset);
  if (!(scale > 0)) return false;
  const double grown = std::max(0.0, offset);
  const Vec2 page{scale * (shape.page.x - grown), scale * (shape.page.y - grown)};
  if (project.shapeFile.empty()) {
    project.builtinSize = {page.x, isRound(project.builtin) ? 0 : page.y};
    project.builtinRadius *= scale;
    if (project.builtin == BuiltinShape::Ring) project.builtinInner *= scale;
  } else {
    project.pageWidth = page.x;
  }
  for (RoundHole& hole : project.holes) hole.centre = percent * hole.centre;
  for (Layer& layer : project.layers) {
    if (layer.at) layer.at = percent * *layer.at;
    layer.size = percent * layer.size;
    for (double* length : lengthsOf(layer)) *length *= percent;
    if (auto* strokes = layer.as<StrokesLayer>()) {
      for (Stroke& stroke : strokes->strokes) {
        for (Vec2& point : stroke.points) point = percent * point;
      }
    }
  }
  return true;
}

}  // namespace sillon
