#include "gcode/base_layers.hpp"

#include <algorithm>
#include <array>

#include "base/decimal_text.hpp"
#include "gcode/hatch.hpp"
#include "gcode/layout.hpp"
#include "gcode/offset_loops.hpp"

namespace sillon {
namespace {

constexpr double kMinHatch = 0.9;  // [area of the shape]
constexpr double kOverlap = 0.1;   // [line width] of the hatch with its perimeter
constexpr int kMaxLoops = 1000;    // of a concentric layer

struct BasePaths {
  std::vector<BeadPath> paths;
  double areaMm2 = 0;
};

// What hatched layers have along the border: the same for all of them.
// \param smaller  not null: where the same for a border that lies `inset` further inside goes.
Result<std::vector<Polyline>> borderLoops(const Shape& shape, const Printer& printer, const PrintParams& params,
                                          std::vector<Polyline>* smaller, double inset) {
  const bool closed = params.basePattern == BasePattern::Concentric;
  const int count = closed ? kMaxLoops : params.basePerimeters;
  if (count == 0) return std::vector<Polyline>();
  return offsetLoops(shape, -printer.nozzle / 2, -printer.nozzle, count, smaller, inset);
}

BasePaths basePaths(const Shape& shape, PointUm offset, const Printer& printer, const PrintParams& params,
                    const std::vector<Polyline>& loops, int turn, double inset) {
  const double width = printer.nozzle;
  BasePaths result;
  const auto addPath = [&](const Polyline& line, bool loop) {
    BeadPath path = placed(line, offset, width, loop);
    if (path.points.size() < (loop ? 3U : 2U)) return;
    for (std::size_t i = 0; i + (loop ? 0 : 1) < path.points.size(); ++i) {
      const std::size_t next = i + 1 < path.points.size() ? i + 1 : 0;
      result.areaMm2 += width * lengthMm(path.points[next] - path.points[i]);
    }
    result.paths.push_back(std::move(path));
  };
  for (const Polyline& loop : loops) addPath(loop, true);
  if (params.basePattern == BasePattern::Concentric) return result;
  const int perimeters = params.basePerimeters;
  const double margin = inset + perimeters * width - (perimeters > 0 ? kOverlap * width : 0);
  for (const Polyline& line : hatchLines(shape, width, turn % 2 == 1, margin)) addPath(line, false);
  return result;
}

}  // namespace

// A base layer that is missing somewhere leaves the layers above it hanging in the air there.
std::optional<Error> addBaseLayers(GcodeJob& job, const Shape& shape, double area, PointUm offset,
                                   const Printer& printer, const PrintParams& params) {
  if (params.basePattern == BasePattern::Same) return std::nullopt;
  std::array<bool, 2> used{};
  for (int turn = 0; turn < params.base; ++turn) {
    const bool own = params.basePattern == BasePattern::Across && nextTo(params, turn) != NextTo::Base;
    used[static_cast<std::size_t>(turn % 2)] |= !own;
  }
  if (!used[0] && !used[1]) return std::nullopt;
  const bool firstIsPlain = used[0] && !(needsAcross(params) && params.base == 1);
  const bool firstIsSmaller =
      params.elephantFoot > 0 && firstIsPlain && params.showSide == ShowSide::Up && beginsOnBed(params);
  double least = 1;
  std::vector<Polyline> smaller;
  const Result<std::vector<Polyline>> loops =
      borderLoops(shape, printer, params, firstIsSmaller ? &smaller : nullptr, params.elephantFoot);
  if (!loops) return loops.error();
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (!used[k]) continue;
    if (k == 1 && params.basePattern == BasePattern::Concentric) {
      job.bases[1] = job.bases[0];
      break;
    }
    BasePaths base = basePaths(shape, offset, printer, params, loops.value(), static_cast<int>(k), 0);
    least = std::min(least, base.areaMm2 / area);
    job.bases[k] = std::move(base.paths);
  }
  if (least <= 0) {
    return Error{ErrorCode::InvalidArgument, "base is " + std::to_string(params.base) +
                                                 ", but the shape is too thin for lines of " +
                                                 decimal(printer.nozzle, 3) + " mm; it must be 0 here"};
  }
  if (least < kMinHatch) job.warn(WarningCode::BaseTooThin, {{"percent", percent(least)}});
  if (firstIsSmaller) {
    job.firstBase = basePaths(shape, offset, printer, params, smaller, 0, params.elephantFoot).paths;
  }
  return std::nullopt;
}

}  // namespace sillon
