#include "gcode/read_back.hpp"

#include <algorithm>

#include "base/refused.hpp"
#include "gcode/job.hpp"
#include "gcode/layout.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kSameHeight = 1e-4;  // [mm], a tenth of the last digit of Z in files
constexpr double kMargin = 1;         // [mm] around the page, as beads may reach a little beyond the shape
constexpr float kWidestTold = 100;    // [mm], limit for moves too short to tell their width

/// Collects the beads of the visible layer.
class ReadBackLayer {
 public:
  ReadBackLayer(const Shape& shape, const Printer& printer, const PrintParams& params, double spacing)
      : turn_(turning(params), shape.page), page_(shape.page), lowest_(params.showSide == ShowSide::Bed) {
    const Shape turned = turn_.none() ? shape : turn_.apply(shape);
    offset_ = mm(placement(bounds(turned), printer, params));
    widthPerFilament_ =
        filamentArea(printer.filamentDiameter) / (params.layerHeight * params.flow * printer.filamentFlow);
    toolpath_.spacing = spacing;
  }

  void add(const MachineMove& move) {
    if (!toolpath_.cycles.empty()) {
      if (lowest_ ? move.z > z_ + kSameHeight : move.z < z_ - kSameHeight) return;
      if (lowest_ ? move.z < z_ - kSameHeight : move.z > z_ + kSameHeight) toolpath_.cycles.clear();
    }
    const Vec2 from = turn_.invert(move.from - offset_), to = turn_.invert(move.to - offset_);
    if (!onPage(from) || !onPage(to)) return;
    z_ = move.z;
    const bool goesOn = !toolpath_.cycles.empty() && move.from == end_;
    if (!goesOn) {
      close();
      toolpath_.cycles.emplace_back();
    }
    Cycle& cycle = toolpath_.cycles.back();
    cycle.points.push_back({static_cast<float>(from.x), static_cast<float>(from.y)});
    cycle.widths.push_back(std::min(kWidestTold, static_cast<float>(widthPerFilament_ * move.e / move.length)));
    end_ = move.to;
  }

  Toolpath finish() {
    close();
    return std::move(toolpath_);
  }

 private:
  static PrintParams turning(PrintParams params) {
    if (params.showSide == ShowSide::Bed) params.mirror = !params.mirror;
    return params;
  }
  [[nodiscard]] bool onPage(Vec2 p) const {
    return p.x > -kMargin && p.y > -kMargin && p.x < page_.x + kMargin && p.y < page_.y + kMargin;
  }
  /// Ends the current path. One that does not end where it began is open, and keeps its last point.
  void close() {
    if (toolpath_.cycles.empty()) return;
    Cycle& cycle = toolpath_.cycles.back();
    const Vec2 last = turn_.invert(end_ - offset_);
    const Vec2f p{static_cast<float>(last.x), static_cast<float>(last.y)};
    if (length(p - cycle.points.front()) < 1e-3f) return;
    cycle.points.push_back(p);
    cycle.widths.push_back(cycle.widths.back());
  }

  PlateTransform turn_;
  Vec2 page_;
  bool lowest_;
  Vec2 offset_;
  double widthPerFilament_ = 0;
  double z_ = 0;
  Vec2 end_;
  Toolpath toolpath_;
};

}  // namespace

Result<Toolpath> readBack(std::string_view gcode, const Shape& shape, const Printer& printer, const PrintParams& params,
                          double spacing) {
  ReadBackLayer layer(shape, printer, params, spacing);
  MachineState machine(printer.flavor);
  bool oriented = false;
  forEachLine(gcode, [&](const GcodeLine& line) {
    const GcodeParts parts = partsOf(line.text);
    if (parts.comment.starts_with("TYPE:")) oriented = parts.comment == "TYPE:Top solid infill";
    if (parts.code.empty()) return;
    const GcodeCommand command = commandOf(parts.code);
    const auto move = runCommand(machine, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
    if (oriented && move && move->e > 0 && move->length > 0) layer.add(*move);
  });
  Toolpath toolpath = layer.finish();
  if (toolpath.cycles.empty()) return refusedFile("NotOriented");
  return toolpath;
}

}  // namespace sillon
