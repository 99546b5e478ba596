// Plates made by formula, for the tests of the stages.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "sillon/pipeline/pipeline.hpp"

namespace scenes {

using sillon::DirectionMap;
using sillon::DirectionMode;
using sillon::PlateInput;
using sillon::Ring;
using sillon::Shape;
using sillon::Vec2;

inline constexpr sillon::PerimeterMode kPerimeterModes[] = {sillon::PerimeterMode::None, sillon::PerimeterMode::Soft,
                                                            sillon::PerimeterMode::Count};

/// Small repeatable random numbers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 0x1234567) {}
  std::uint64_t bits() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return state_;
  }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; }
  int index(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }

 private:
  std::uint64_t state_;
};

inline Ring circle(Vec2 centre, double radius, int corners = 180) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double a = 2 * std::numbers::pi * k / corners;
    ring.push_back({centre.x + radius * std::cos(a), centre.y + radius * std::sin(a)});
  }
  return ring;
}

/// Area: positive for rings that turn to the left [mm²].
inline double shoelace(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += cross(ring[i], ring[(i + 1) % ring.size()]);
  return sum / 2;
}

inline Ring rectangle(Vec2 low, Vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

inline Ring star(Vec2 centre, double outer, double inner, int tips) {
  Ring ring;
  for (int k = 0; k < 2 * tips; ++k) {
    const double a = std::numbers::pi * k / tips;
    const double r = k % 2 == 0 ? outer : inner;
    ring.push_back({centre.x + r * std::cos(a), centre.y + r * std::sin(a)});
  }
  return ring;
}

inline Shape shapeOf(std::vector<Ring> rings, Vec2 page, sillon::FillRule rule = sillon::FillRule::EvenOdd) {
  return {{{std::move(rings), rule}}, page};
}

/// One curve for each list of points.
inline sillon::ClosedCurves closed(const std::vector<std::vector<sillon::Vec2f>>& cycles) {
  sillon::ClosedCurves curves;
  for (const std::vector<sillon::Vec2f>& cycle : cycles) {
    curves.begin.push_back(static_cast<int>(curves.points.size()));
    curves.points.insert(curves.points.end(), cycle.begin(), cycle.end());
  }
  curves.begin.push_back(static_cast<int>(curves.points.size()));
  return curves;
}

/// A map of n x n texels from the bead's angle [rad] at the texel's place in [0, 1]², y up.
inline DirectionMap mapOf(int n, const std::function<double(double, double)>& angle) {
  DirectionMap map{n, n, {}};
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const double a = angle((column + 0.5) / n, 1 - (row + 0.5) / n);
      const double turns = a / std::numbers::pi + 0.5;
      map.angle.push_back(static_cast<std::uint16_t>(std::lround((turns - std::floor(turns)) * 65535)));
    }
  }
  return map;
}

struct Scene {
  std::string name;
  PlateInput input;
  int parts = 1;  ///< at spacing 0.4, bridged by one spacing
};

inline PlateInput plate(Shape shape, DirectionMap map, DirectionMode mode = DirectionMode::Constrained) {
  return {std::move(shape), std::move(map), sillon::uniformMode(mode)};
}

inline DirectionMap swirl() {
  return mapOf(
      96, [](double x, double y) { return std::atan2(y - 0.5, x - 0.5) + 0.7 + 1.5 * std::hypot(x - 0.5, y - 0.5); });
}

inline DirectionMap waves() {
  return mapOf(96, [](double x, double y) { return 0.9 * std::sin(7 * x + 2 * y) + 0.5 * std::sin(5 * y); });
}

inline DirectionMap mosaic() {
  return mapOf(64, [](double x, double y) {
    const int cell = static_cast<int>(x * 4) * 7 + static_cast<int>(y * 4) * 3;
    return (cell % 5) * 0.6;
  });
}

inline DirectionMap noise(std::uint64_t seed) {
  Random random(seed);
  return mapOf(64, [&](double, double) { return random.in(0, std::numbers::pi); });
}

/// Shapes with closed forms or known parts.
inline std::vector<Scene> all() {
  std::vector<Scene> scenes;
  scenes.push_back({"disc", plate(shapeOf({circle({8, 8}, 8)}, {16, 16}), waves())});
  scenes.push_back({"ring", plate(shapeOf({circle({8, 8}, 8), circle({8, 8}, 3)}, {16, 16}), swirl())});
  scenes.push_back({"star", plate(shapeOf({star({9, 9}, 9, 3.5, 5)}, {18, 18}), mosaic())});
  scenes.push_back({"two islands", plate(shapeOf({circle({5, 5}, 5), circle({16, 5}, 4)}, {20, 10}), waves()), 2});
  scenes.push_back(
      {"bridged islands", plate(shapeOf({rectangle({0, 0}, {6, 8}), rectangle({6.2, 0}, {13, 8})}, {13, 8}), waves())});
  scenes.push_back({"neck", plate(shapeOf({circle({5, 5}, 5), circle({16, 5}, 5), rectangle({9, 4.85}, {12, 5.15})},
                                          {21, 10}, sillon::FillRule::NonZero),
                                  waves())});
  scenes.push_back({"sliver", plate(shapeOf({rectangle({0, 0}, {20, 0.5})}, {20, 0.5}), waves())});
  scenes.push_back({"two beads", plate(shapeOf({rectangle({0, 0}, {20, 0.85})}, {20, 0.85}), waves())});
  scenes.push_back({"noise", plate(shapeOf({rectangle({0, 0}, {14, 11})}, {14, 11}), noise(3))});
  scenes.push_back({"parallel", plate(shapeOf({star({9, 9}, 9, 5, 6)}, {18, 18}), waves(), DirectionMode::Parallel)});
  scenes.push_back({"orthogonal", plate(shapeOf({circle({7, 7}, 7)}, {14, 14}), waves(), DirectionMode::Orthogonal)});
  scenes.push_back({"smoothest", plate(shapeOf({star({8, 8}, 8, 4, 3)}, {16, 16}), waves(), DirectionMode::Smoothest)});
  PlateInput modes = plate(shapeOf({circle({9, 9}, 9), circle({11, 9}, 3)}, {18, 18}), waves());
  modes.modes = {
      2, 2, {DirectionMode::Parallel, DirectionMode::Orthogonal, DirectionMode::Smoothest, DirectionMode::Constrained}};
  scenes.push_back({"four modes", modes});
  return scenes;
}

}  // namespace scenes
