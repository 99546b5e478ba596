#include "gcode/base_layers.hpp"

#include <algorithm>

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

Result<BasePaths> basePaths(const Shape& shape, PointUm offset, const Printer& printer, BasePattern pattern,
                            int perimeters, int turn, double inset) {
  const double width = printer.nozzle;
  const bool closed = pattern == BasePattern::Concentric;
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
  std::vector<Polyline> lines;
  if (closed) {
    Result<std::vector<Polyline>> loops = offsetLoops(shape, -inset - width / 2, -width, kMaxLoops);
    if (!loops) return loops.error();
    lines = std::move(loops).value();
  } else {
    if (perimeters > 0) {
      Result<std::vector<Polyline>> loops = offsetLoops(shape, -inset - width / 2, -width, perimeters);
      if (!loops) return loops.error();
      for (const Polyline& loop : loops.value()) addPath(loop, true);
    }
    lines =
        hatchLines(shape, width, turn % 2 == 1, inset + perimeters * width - (perimeters > 0 ? kOverlap * width : 0));
  }
  for (const Polyline& line : lines) addPath(line, closed);
  return result;
}

}  // namespace

// A base layer that is missing somewhere leaves the layers above it hanging in the air there.
std::optional<Error> addBaseLayers(GcodeJob& job, const Shape& shape, double area, PointUm offset,
                                   const Printer& printer, const PrintParams& params) {
  if (params.base == 0 || params.basePattern == BasePattern::Same) return std::nullopt;
  double least = 1;
  const auto turns = std::min<std::size_t>(job.bases.size(), static_cast<std::size_t>(params.base));
  for (std::size_t k = 0; k < turns; ++k) {
    if (k == 1 && params.basePattern == BasePattern::Concentric) {
      job.bases[1] = job.bases[0];
      break;
    }
    Result<BasePaths> base =
        basePaths(shape, offset, printer, params.basePattern, params.basePerimeters, static_cast<int>(k), 0);
    if (!base) return base.error();
    least = std::min(least, base.value().areaMm2 / area);
    job.bases[k] = std::move(base).value().paths;
  }
  if (least <= 0) {
    return Error{ErrorCode::InvalidArgument, "base is " + std::to_string(params.base) +
                                                 ", but the shape is too thin for lines of " +
                                                 decimal(printer.nozzle, 3) + " mm; it must be 0 here"};
  }
  if (least < kMinHatch) job.warn(WarningCode::BaseTooThin, {{"percent", percent(least)}});
  if (params.elephantFoot > 0 && params.showSide == ShowSide::Up && beginsOnBed(params)) {
    Result<BasePaths> first =
        basePaths(shape, offset, printer, params.basePattern, params.basePerimeters, 0, params.elephantFoot);
    if (!first) return first.error();
    job.firstBase = std::move(first).value().paths;
  }
  return std::nullopt;
}

}  // namespace sillon
