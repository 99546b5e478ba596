#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "export/zone_parts.hpp"

namespace sillon {
namespace {

constexpr double kBeyond = 1;         // [mm] by which slabs reach beyond the body
constexpr double kLeastArea = 1;      // [mm²]; steps with a smaller area of tops are ignored
constexpr double kLevel = 1e-3;       // [mm], largest rise of a level triangle
constexpr double kSolidDepth = 2;     // [mm], depth below a top that slicers fill solidly at most
constexpr double kSolidLayers = 8;    // layers, the same if they are thicker together
constexpr double kNarrowStep = 0.45;  // [mm], width of a step; steeper slopes show walls only

using Corner3 = std::array<double, 3>;

// Six times the volume of a body; below 0 if its triangles face inwards.
double volumeOf(const Mesh& body) {
  double six = 0;
  for (const auto& t : body.triangles) {
    const Corner3& a = body.points[t[0]];
    const Corner3& b = body.points[t[1]];
    const Corner3& c = body.points[t[2]];
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six;
}

double depthOf(double layerHeight) { return std::max(kSolidDepth, kSolidLayers * layerHeight) + layerHeight; }

}  // namespace

Slab slabUnder(double top, double layerHeight) { return {top - depthOf(layerHeight), top + layerHeight}; }

std::vector<Slab> slabsOf(const Mesh& body, double layerHeight, std::size_t most) {
  double low = body.points.front()[2];
  double high = low;
  for (const Corner3& p : body.points) {
    low = std::min(low, p[2]);
    high = std::max(high, p[2]);
  }
  // Heights are counted in steps of one layer, which need not coincide with the slicer's layers.
  const auto stepOf = [&](double z) { return toSize((z - low) / layerHeight); };
  const std::size_t count = stepOf(high) + 1;
  std::vector<double> level(count, 0);       // area of the tops in each step [mm²]
  std::vector<double> change(count + 1, 0);  // difference of the slopes' area from the step below [mm²]
  const double steepest = layerHeight / kNarrowStep;
  const double outwards = volumeOf(body) < 0 ? -1 : 1;
  for (const auto& t : body.triangles) {
    const Corner3& a = body.points[t[0]];
    const Corner3& b = body.points[t[1]];
    const Corner3& c = body.points[t[2]];
    const Corner3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Corner3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double up = outwards * (u[0] * v[1] - u[1] * v[0]);
    if (!(up > 0)) continue;
    const auto [lowest, highest] = std::minmax({a[2], b[2], c[2]});
    if (highest - lowest <= kLevel) {
      level[stepOf(highest)] += up / 2;
      continue;
    }
    if (std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]) > steepest * up) continue;
    const double share = up / 2 / static_cast<double>(stepOf(highest) - stepOf(lowest) + 1);
    change[stepOf(lowest)] += share;
    change[stepOf(highest) + 1] -= share;
  }
  const double depth = depthOf(layerHeight);
  std::vector<Slab> slabs;
  double slope = 0;
  for (std::size_t k = 0; k < count; ++k) {
    slope += change[k];
    const bool last = k + 1 == count;
    if (level[k] + slope < kLeastArea && !last) continue;
    const double bottom = low + static_cast<double>(k) * layerHeight;
    const Slab slab{bottom - depth > low ? bottom - depth : low - kBeyond,
                    last ? high + kBeyond : bottom + layerHeight};
    if (slabs.empty() || slabs.back().top < slab.bottom) slabs.push_back(slab);
    slabs.back().top = slab.top;
  }
  if (slabs.size() > most) slabs = {{low - kBeyond, high + kBeyond}};
  return slabs;
}

}  // namespace sillon
