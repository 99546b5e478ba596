#include "gcode/base_layers.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/signed_distance.hpp"
#include "geometry/straightened.hpp"
#include "sillon/base/run_context.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

constexpr double kMostNodes = 4e6;
constexpr double kTolerance = 0.005;  // [mm], distance of omitted points from the loop
constexpr double kLongest = 2;        // [mm], longest piece of a loop, so that speeds can follow

}  // namespace

Result<std::vector<Polyline>> offsetLoops(const Shape& shape, double first, double step, int count,
                                          std::vector<Polyline>* second, double shift) {
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  const double last = first + step * (count - 1) + (second != nullptr ? std::copysign(shift, step) : 0);
  const double reach = std::max({0.0, first, last}) + std::abs(step);
  const Bounds box = outline.value().bounds;
  const Vec2 size = box.size() + Vec2{2 * reach, 2 * reach};
  Grid lattice;
  lattice.cell = std::max(std::abs(step) / 4, std::sqrt(size.x * size.y / kMostNodes));
  lattice.nx = static_cast<int>(size.x / lattice.cell) + 3;
  lattice.ny = static_cast<int>(size.y / lattice.cell) + 3;
  lattice.origin = box.min - Vec2{reach + lattice.cell, reach + lattice.cell};

  const RunContext run(1);
  // Blocks are twice as large as this lattice needs: with a quarter as many of them, a detailed border takes half the
  // time.
  const Grid coarse{lattice.origin, 2 * lattice.cell, lattice.nx / 2 + 1, lattice.ny / 2 + 1};
  const Result<BorderIndex> border = buildBorderIndex(outline.value(), coarse, run);
  if (!border) return border.error();
  // Distances are only needed near the levels of the loops.
  const Result<std::vector<float>> measured =
      bandDistance(shape, border.value(), lattice,
                   static_cast<float>(std::max(std::abs(first), std::abs(last)) + 2 * lattice.cell), run);
  if (!measured) return measured.error();
  const std::vector<float>& distance = measured.value();
  std::vector<float> values(distance.size());
  // All points count as far outside, so that contourCycles takes linear roots and not those of a wave.
  const std::vector<float> far(values.size(), 1e9F);
  std::vector<Polyline> own;
  for (std::vector<Polyline>* loops : {&own, second}) {
    if (loops == nullptr) continue;
    const double begin = loops == second ? first + std::copysign(shift, step) : first;
    for (int k = 0; k < count; ++k) {
      const auto level = static_cast<float>(begin + step * k);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = distance[i] - level;
      const Result<ClosedCurves> curves = contourCycles(lattice, values, far, std::abs(step), run);
      if (!curves) return curves.error();
      if (curves.value().count() == 0) break;
      for (int c = 0; c < curves.value().count(); ++c) {
        Polyline line;
        const std::size_t from = curves.value().begin[c];
        for (int i = 0; i < curves.value().size(c); ++i) {
          const Vec2f p = curves.value().points[from + i];
          line.push_back(wide(p));
        }
        line = straightened(line, kTolerance, kLongest);
        if (line.size() >= 3) loops->push_back(std::move(line));
      }
    }
  }
  return own;
}

}  // namespace sillon
