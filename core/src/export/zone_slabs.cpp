#include "export/zone_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sillon {
namespace {

constexpr double kBeyond = 1;         // [mm] below and above the body
constexpr double kLeastArea = 1;      // [mm²] of a layer's tops that count
constexpr double kLevel = 1e-3;       // [mm] that a level triangle may rise
constexpr double kSolidDepth = 2;     // [mm] below a top that slicers fill solidly, at most
constexpr int kSolidLayers = 8;       // or so many, if they are thicker
constexpr double kNarrowStep = 0.45;  // [mm]; on a slope of narrower steps only walls are seen

using Corner3 = std::array<double, 3>;

enum class Lines : char { Slicers, Straight, Turned };

// Slicers turn their lines on every other layer, from the second on.
Lines linesOn(std::int64_t layer) { return layer % 2 != 0 ? Lines::Turned : Lines::Straight; }

struct Tops {
  std::vector<std::int64_t> level;  // layers, rising
  std::vector<double> slopes;       // [mm²] of each layer
};

class Layers {
 public:
  Layers(const Mesh& body, const ZoneLayers& layers) : body_(body), layers_(layers) {
    low_ = high_ = body.points.front()[2];
    for (const Corner3& p : body.points) {
      low_ = std::min(low_, p[2]);
      high_ = std::max(high_, p[2]);
    }
  }

  // \return the layer that ends at a top: the last one whose middle lies below it.
  // In a tie PrusaSlicer lays no layer at the very top of a body, others it does.
  [[nodiscard]] std::int64_t at(double z) const {
    constexpr double kTie = 1e-4;
    const double index = (z - low_ - layers_.firstHeight) / layers_.height;
    return std::max<std::int64_t>(0, std::llround(z >= high_ ? index - kTie : index + kTie));
  }
  [[nodiscard]] std::int64_t last() const { return at(high_); }
  [[nodiscard]] double topOf(std::int64_t layer) const {
    return layer >= last() ? high_ + kBeyond : low_ + layers_.firstHeight + static_cast<double>(layer) * layers_.height;
  }
  [[nodiscard]] double bottomOf(std::int64_t layer) const { return layer == 0 ? low_ - kBeyond : topOf(layer - 1); }
  [[nodiscard]] std::int64_t solid() const {
    return std::max<std::int64_t>(kSolidLayers, std::llround(kSolidDepth / layers_.height));
  }

  [[nodiscard]] Tops tops() const {
    const auto count = static_cast<std::size_t>(last()) + 1;
    const double steepest = layers_.height / kNarrowStep;
    const double outwards = volume() < 0 ? -1 : 1;
    std::vector<double> level(count, 0);
    std::vector<double> change(count + 1, 0);  // of the slopes' area, from the layer below
    for (const auto& t : body_.triangles) {
      const Corner3& a = body_.points[t[0]];
      const Corner3& b = body_.points[t[1]];
      const Corner3& c = body_.points[t[2]];
      const Corner3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
      const Corner3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      const double up = outwards * (u[0] * v[1] - u[1] * v[0]);
      if (!(up > 0)) continue;
      const auto [lowest, highest] = std::minmax({a[2], b[2], c[2]});
      if (highest - lowest <= kLevel) {
        level[static_cast<std::size_t>(std::min(last(), at(a[2])))] += up / 2;
        continue;
      }
      if (std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]) > steepest * up) continue;
      const auto from = static_cast<std::size_t>(std::min(last(), at(lowest)));
      const auto to = static_cast<std::size_t>(std::min(last(), at(highest)));
      const double share = up / 2 / static_cast<double>(to - from + 1);
      change[from] += share;
      change[to + 1] -= share;
    }
    Tops tops;
    tops.slopes.resize(count);
    double slope = 0;
    for (std::size_t k = 0; k < count; ++k) {
      slope += change[k];
      tops.slopes[k] = slope;
      if (level[k] >= kLeastArea || k + 1 == count) tops.level.push_back(static_cast<std::int64_t>(k));
    }
    return tops;
  }

 private:
  // Below 0 where the triangles face inwards.
  [[nodiscard]] double volume() const {
    double six = 0;
    for (const auto& t : body_.triangles) {
      const Corner3& a = body_.points[t[0]];
      const Corner3& b = body_.points[t[1]];
      const Corner3& c = body_.points[t[2]];
      six +=
          a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return six;
  }

  const Mesh& body_;
  ZoneLayers layers_;
  double low_ = 0;
  double high_ = 0;
};

std::vector<Lines> linesOfLayers(const Layers& layers, const Tops& tops, bool slopes) {
  std::vector<Lines> lines(static_cast<std::size_t>(layers.last()) + 1, Lines::Slicers);
  const auto fill = [&](std::int64_t top) {
    for (std::int64_t k = std::max<std::int64_t>(0, top - layers.solid()); k <= top; ++k)
      lines[static_cast<std::size_t>(k)] = linesOn(top);
  };
  const auto isSlope = [&](std::size_t k) { return slopes && tops.slopes[k] >= kLeastArea; };
  for (std::size_t k = lines.size(); k-- > 0;) {
    if (isSlope(k) && (k == 0 || !isSlope(k - 1))) fill(static_cast<std::int64_t>(k));
  }
  // The lower top decides where the solid layers of two meet.
  for (std::size_t k = tops.level.size(); k-- > 0;) fill(tops.level[k]);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (isSlope(k)) lines[k] = linesOn(static_cast<std::int64_t>(k));
  }
  return lines;
}

}  // namespace

Slabs slabsOf(const Mesh& body, const ZoneLayers& zoneLayers, std::size_t most) {
  const Layers layers(body, zoneLayers);
  const Tops tops = layers.tops();
  for (const bool slopes : {true, false}) {
    const std::vector<Lines> lines = linesOfLayers(layers, tops, slopes);
    std::vector<Slab> slabs;
    for (std::size_t begin = 0; begin < lines.size();) {
      std::size_t end = begin;
      while (end < lines.size() && lines[end] == lines[begin]) ++end;
      if (lines[begin] != Lines::Slicers) {
        slabs.push_back({layers.bottomOf(static_cast<std::int64_t>(begin)),
                         layers.topOf(static_cast<std::int64_t>(end) - 1), lines[begin] == Lines::Turned});
      }
      begin = end;
    }
    if (slabs.size() <= most) return {std::move(slabs), slopes};
  }
  return {{{layers.bottomOf(0), layers.topOf(layers.last()), linesOn(layers.last()) == Lines::Turned}}, false};
}

}  // namespace sillon
