#include "compose/ink.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/parallel_for.hpp"
#include "compose/lines.hpp"
#include "compose/region.hpp"
#include "compose/strokes.hpp"
#include "compose/visible.hpp"

namespace sillon {
namespace {

LineAt oneLine(double degrees) {
  return [line = lineOf(degrees * kDegree)](Vec2 /*anywhere*/) { return line; };
}

/// Returns the lines of a layer at every place where it shows.
Result<LineAt> linesOf(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate,
                       LayerPictures& pictures, const RunContext& run) {
  const double spacing = plate.project.toolpath.spacing;
  if (layer.as<MapLayer>() != nullptr) return mapLines(content, place);
  if (layer.as<PictureLayer>() != nullptr) return pictureLines(layer, content, place, plate, pictures, run);
  if (const auto* code = layer.as<CodeLayer>()) return codeLinesAt(*code, content, place);
  if (const auto* tones = layer.as<TonesLayer>()) return tonesLines(*tones, content, place, spacing);
  const auto* pattern = layer.as<PatternLayer>();
  if (pattern != nullptr && pattern->pattern != LayerPattern::Echo) return patternLines(*pattern, place);
  const auto* filled = layer.as<LayerFilled>();
  if (pattern != nullptr || (filled != nullptr && filled->fill == LayerFill::Along)) {
    const bool border = layer.as<BorderLayer>() != nullptr;
    return alongLines(border ? plate.shape : place.stretched(*content.shape, plate.shape.page), spacing, run);
  }
  return oneLine(layer.as<LayerAngle>()->angle);
}

/// Returns the mode of a layer at a place; a picture of modes may decide.
DirectionMode modeAt(const Layer& layer, const LayerContent& content, const Placement& place, Vec2 at) {
  const ModeMap& modes = content.modes;
  if (modes.mode.size() == 1) return modes.mode[0];
  const auto texel = texelOf(modes, place.toOwn(at), content.size);
  return texel ? modes.mode[*texel] : layer.mode;
}

}  // namespace

void blend(LayerStack::Texel& texel, std::optional<Vec2f> line, float cover) {
  const float kept = line ? 1 - cover : 1 - 2 * cover;  // the line across another one is its negative
  texel.line = texel.line * kept;
  if (line) texel.line = texel.line + *line * cover;
  texel.through *= kept;
  texel.cover = cover + texel.cover * (1 - cover);
}

std::optional<Error> drawLayer(std::size_t number, const LayerContent& content, const Placement& place,
                               const LayerPlate& plate, LayerStack& stack, const RunContext& run) {
  const Layer& layer = plate.project.layers[number];
  if (const auto* strokes = layer.as<StrokesLayer>()) return drawStrokes(*strokes, number, plate, stack, run);
  LayerPictures pictures;
  const auto known = stack.pictures.find(number);
  if (known != stack.pictures.end()) pictures = known->second;
  const Result<LineAt> lines = linesOf(layer, content, place, plate, pictures, run);
  if (!lines) return lines.error();
  const Region region = regionOf(layer, content, place, plate);
  const std::vector<float> cover = coverOf(region.shown, plate, layer.soft);
  const bool codes = layer.as<CodeLayer>() != nullptr;
  const auto* filled = layer.as<LayerFilled>();
  const bool across = filled != nullptr && filled->fill == LayerFill::Across;
  const Vec2 step{plate.shape.page.x / plate.width, plate.shape.page.y / plate.height};
  std::optional<Vec2f> ground;
  if (outlined(layer) && layer.as<LayerGround>()->ground) ground = lineOf(*layer.as<LayerGround>()->ground * kDegree);
  stack.inks.push_back(inkOf(number, content, place, plate, region, stack));
  for (int y = 0; y < plate.height; ++y) {
    if (run.poll()) return cancelledRun();
    for (int x = 0; x < plate.width; ++x) {
      const std::size_t k = indexOf(x, y, plate.width);
      if (cover[k] == 0) continue;
      const bool drawn = region.content.empty() || region.content[k] != 0;
      const Vec2 at{(x + 0.5) * step.x, (plate.height - y - 0.5) * step.y};
      std::optional<Vec2f> line;
      if (!drawn && ground) {
        line = ground;
      } else if (!across) {
        line = lines.value()(at);
      }
      LayerStack::Texel& texel = stack.texels[k];
      if (cover[k] >= 0.5F) {
        texel.mode = modeAt(layer, content, place, at);
        texel.top = static_cast<std::uint8_t>(number + 1);
        texel.ink = !drawn ? LayerStack::Ink::None : codes ? LayerStack::Ink::Turned : inkOver(texel, line, ground);
      }
      blend(texel, line, cover[k]);
    }
  }
  // A layer entirely beside the page has no solved pictures.
  if (!pictures.shown.empty()) stack.pictures[number] = std::move(pictures);
  return std::nullopt;
}

}  // namespace sillon
