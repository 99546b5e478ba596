#include "calibrate/prints.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"

namespace sillon {

std::string written(double value, int digits) {
  const std::string text = fixed(value, digits);
  if (text.starts_with("0.")) return text.substr(1);
  return text.starts_with("-0.") ? std::string("-").append(text, 2) : text;
}

PlateBuilder::PlateBuilder(const CalibrationRequest& request, std::vector<double> values) : values_(std::move(values)) {
  const CalibrationRow& kind = rowOf(request.kind);
  plate_.kind = request.kind;
  plate_.setting = kind.setting;
  plate_.unit = kind.unit;
  plate_.advice = kind.advice;
  plate_.printer = request.project.printer;
  PrintParams& print = plate_.print = request.project.print;
  print.showSide = ShowSide::Up;
  print.rotate = 0;
  print.mirror = false;
  print.copies = {1, 1};
  print.startHeight = 0;
  print.place.reset();
  print.basePattern = BasePattern::Hatched;
  print.constantFlow = false;
  print.base = 1;
  print.layers = 1;
  print.rim = 0;
  plate_.patches.patches.emplace_back();  // the first patch has the labels, which test nothing
  plate_.patches.patches.front().layer = 1;
}

int PlateBuilder::digits() const {
  int digits = 0;
  for (const double value : values_) {
    const std::string text = decimal(value, rowOf(plate_.kind).digits);
    const std::size_t point = text.find('.');
    if (point != std::string::npos) digits = std::max(digits, static_cast<int>(text.size() - point - 1));
  }
  return digits;
}

Patch& PlateBuilder::patch(std::vector<PatchLine> lines, int layer) {
  Patch patch;
  patch.layer = layer;
  patch.lines = std::move(lines);
  patch.flow = plate_.print.flow;
  plate_.patches.patches.push_back(std::move(patch));
  return plate_.patches.patches.back();
}

void PlateBuilder::draw(std::vector<PatchLine> lines) {
  std::vector<PatchLine>& all = labels().lines;
  for (PatchLine& line : lines) all.push_back(std::move(line));
}

void PlateBuilder::label(const std::string& text, Vec2 corner, double unit) {
  draw(writing(text, corner, unit, width()));
}

void PlateBuilder::labelAt(const std::string& text, Vec2 middle, double unit) {
  label(text, middle - 0.5 * unit * Vec2{textWidth(text), kLetterHeight}, unit);
}

void PlateBuilder::value(double value, std::string label, Vec2 at) {
  plate_.values.push_back({std::move(label), value, at, plate_.patches.patches.size()});
}

CalibrationPlate PlateBuilder::done() && {
  Bounds all;
  for (const Ring& ring : rings_) {
    for (const Vec2 p : ring) all.add(p);
  }
  FilledPath path;
  for (Ring& ring : rings_) {
    for (Vec2& p : ring) p = p - all.min;
    path.rings.push_back(std::move(ring));
  }
  plate_.patches.shape = {{std::move(path)}, all.size()};
  std::erase_if(plate_.patches.patches, [](const Patch& patch) { return patch.lines.empty(); });
  for (Patch& patch : plate_.patches.patches) {
    for (PatchLine& line : patch.lines) {
      for (Vec2& p : line.points) p = p - all.min;
    }
  }
  for (CalibrationValue& value : plate_.values) value.at = value.at - all.min;
  return std::move(plate_);
}

}  // namespace sillon
