#include "gcode/base_layers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "base/refused.hpp"
#include "gcode/layout.hpp"
#include "gcode_reader/coverage.hpp"
#include "geometry/outline.hpp"

namespace sillon {
namespace {

constexpr double kMinCover = 0.98;  // [area of the shape]; less cover gives a warning
constexpr double kCell = 0.125;     // [line width], cell of the raster on which cover is measured
constexpr double kOverlap = 0.1;    // [line width], overlap of the hatch with its perimeter
constexpr int kMaxLoops = 1000;     // loops of a concentric layer at most

// A raster of the plate that measures how much of its body a base layer covers.
class BaseCover {
 public:
  BaseCover(const Shape& body, PointUm offset, double lineWidth)
      : lineWidth_(lineWidth), raster_(placedBox(body, offset), kCell * lineWidth), body_(raster_.none()) {
    const Vec2 place = mm(offset);
    const auto inside = insideIntervals(body, raster_.firstY() - place.y, raster_.cell(), raster_.rows());
    for (int row = 0; row < raster_.rows(); ++row) {
      for (const Interval& piece : inside[row]) raster_.fill(row, piece.begin + place.x, piece.end + place.x, body_);
    }
  }

  // Share of the body that lines cover. Gaps narrower than a cell do not count, because beads are squeezed into them.
  // \param inset  distance that lines keep from the border [mm].
  [[nodiscard]] double shareOf(const std::vector<BeadPath>& paths, double inset) const {
    BeadRaster::Bits covered = raster_.none();
    const auto point = [](PointUm p) { return Vec2f{static_cast<float>(mm(p).x), static_cast<float>(mm(p).y)}; };
    for (const BeadPath& path : paths) {
      for (std::size_t i = 0; i + (path.closed ? 0 : 1) < path.points.size(); ++i) {
        const std::size_t next = i + 1 < path.points.size() ? i + 1 : 0;
        raster_.draw(point(path.points[i]), point(path.points[next]), lineWidth_ + raster_.cell() + 2 * inset, covered);
      }
    }
    for (std::size_t k = 0; k < covered.size(); ++k) covered[k] &= body_[k];
    const std::int64_t all = countOf(body_);
    return all > 0 ? static_cast<double>(countOf(covered)) / static_cast<double>(all) : 1;
  }

 private:
  // The margin keeps the border of drawings, which like round numbers, off the centres of cells.
  static Bounds placedBox(const Shape& body, PointUm offset) {
    const Bounds box = bounds(body);
    const Vec2 margin{0.019, 0.019};
    return {box.min + mm(offset) - margin, box.max + mm(offset)};
  }

  double lineWidth_;
  BeadRaster raster_;
  BeadRaster::Bits body_;
};

// Loops along the border, the same for all base layers.
// \param smaller  null, or the destination of the same loops for a border `inset` further inside.
Result<std::vector<Polyline>> borderLoops(const Shape& shape, const Printer& printer, const PrintParams& params,
                                          std::vector<Polyline>* smaller, double inset) {
  const bool closed = params.basePattern == BasePattern::Concentric;
  const int count = closed ? kMaxLoops : params.basePerimeters;
  if (count == 0) return std::vector<Polyline>();
  return offsetLoops(shape, -printer.nozzle / 2, -printer.nozzle, count, smaller, inset);
}

// Lays out one base layer: its loops along the border, and its hatch inside them. \param turn  odd: the hatch falls.
std::vector<BeadPath> basePaths(const Shape& shape, PointUm offset, const Printer& printer, const PrintParams& params,
                                const std::vector<Polyline>& loops, int turn, double inset) {
  const double width = printer.nozzle;
  std::vector<BeadPath> result;
  const auto addPath = [&](const Polyline& line, bool loop) {
    BeadPath path = placed(line, offset, width, loop);
    if (path.points.size() >= (loop ? 3U : 2U)) result.push_back(std::move(path));
  };
  for (const Polyline& loop : loops) addPath(loop, true);
  if (params.basePattern == BasePattern::Concentric) return result;
  const int perimeters = params.basePerimeters;
  const double margin = inset + perimeters * width - (perimeters > 0 ? kOverlap * width : 0);
  for (const Polyline& line : hatchLines(shape, width, turn % 2 == 1, margin)) addPath(line, false);
  return result;
}

}  // namespace

// Cover is checked because a base layer with a gap leaves the layers above it hanging in the air there.
std::optional<Error> addBaseLayers(GcodeJob& job, const Shape& body, PointUm offset, const Printer& printer,
                                   const PrintParams& params) {
  if (params.basePattern == BasePattern::Same) return std::nullopt;
  std::array<bool, 2> used{};
  for (int turn = 0; turn < params.base; ++turn) {
    const bool own = params.basePattern == BasePattern::Across && nextTo(params, turn) != NextTo::Base;
    used[turn % 2] |= !own;
  }
  if (!used[0] && !used[1]) return std::nullopt;
  const bool firstIsPlain = used[0] && !(needsAcross(params) && params.base == 1);
  const bool firstIsSmaller =
      params.elephantFoot > 0 && firstIsPlain && params.showSide == ShowSide::Up && beginsOnBed(params);
  std::vector<Polyline> smaller;
  const Result<std::vector<Polyline>> loops =
      borderLoops(body, printer, params, firstIsSmaller ? &smaller : nullptr, params.elephantFoot);
  if (!loops) return loops.error();
  const BaseCover cover(body, offset, printer.nozzle);
  double least = 1;
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (!used[k]) continue;
    if (k == 1 && params.basePattern == BasePattern::Concentric) {
      job.bases[1] = job.bases[0];
      break;
    }
    job.bases[k] = basePaths(body, offset, printer, params, loops.value(), static_cast<int>(k), 0);
    if (job.bases[k].empty()) {
      return refusedArgument("TooThinFor",
                             {{"setting", "print.base"}, {"value", params.base}, {"width", printer.nozzle}});
    }
    const bool printed = k == 1 || !firstIsSmaller || params.base > 2;
    if (printed) least = std::min(least, cover.shareOf(job.bases[k], 0));
  }
  if (firstIsSmaller) {
    job.firstBase = basePaths(body, offset, printer, params, smaller, 0, params.elephantFoot);
    least = std::min(least, cover.shareOf(job.firstBase, params.elephantFoot));
  }
  if (least < kMinCover) job.warn(WarningCode::BaseTooThin, {{"percent", percent(least)}});
  return std::nullopt;
}

}  // namespace sillon
