// Plain data shared by all stages: vectors, boxes, images, the toolpath itself.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace sillon {

/// A point or vector of two components. World space: mm, x right, y up, origin at the page's lower
/// left.
template <class T>
struct Vec2T {
  T x{};
  T y{};

  friend constexpr bool operator==(const Vec2T&, const Vec2T&) = default;
  friend constexpr Vec2T operator+(Vec2T a, Vec2T b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2T operator-(Vec2T a, Vec2T b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2T operator-(Vec2T a) { return {-a.x, -a.y}; }
  friend constexpr Vec2T operator*(Vec2T a, T s) { return {a.x * s, a.y * s}; }
  friend constexpr Vec2T operator*(T s, Vec2T a) { return {a.x * s, a.y * s}; }
  friend constexpr T dot(Vec2T a, Vec2T b) { return a.x * b.x + a.y * b.y; }
  /// z component of the cross product; positive when b lies to the left of a.
  friend constexpr T cross(Vec2T a, Vec2T b) { return a.x * b.y - a.y * b.x; }
  friend T length(Vec2T a) { return std::sqrt(a.x * a.x + a.y * a.y); }
};

using Vec2 = Vec2T<double>;  ///< doubles, for outlines and everything that is computed once
using Vec2f = Vec2T<float>;  ///< floats, for dense fields and paths: steps of 0.03 µm at 400 mm

/// Converts a vector to doubles.
template <class T>
constexpr Vec2 wide(Vec2T<T> v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y)};
}

/// Converts an enumerator, a number of 64 bits or a floating one to an index or a size; a fraction
/// is cut off. An int needs no conversion. Debug builds stop at a negative number, which would
/// become a huge index.
template <class T>
constexpr std::size_t toSize(T value) {
  if constexpr (std::is_signed_v<T>) assert(value >= 0);
  return static_cast<std::size_t>(value);
}

/// Index of a cell of a raster that is stored row by row. \param width  cells in a row
constexpr std::size_t indexOf(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

/// Number of cells of a raster, also where an int could not hold it.
constexpr std::size_t cellCount(int columns, int rows) { return indexOf(0, rows, columns); }

/// An axis-parallel box [mm]; it is empty while max < min.
struct Bounds {
  Vec2 min{1e30, 1e30};
  Vec2 max{-1e30, -1e30};

  void add(Vec2 p) {
    if (p.x < min.x) min.x = p.x;
    if (p.y < min.y) min.y = p.y;
    if (p.x > max.x) max.x = p.x;
    if (p.y > max.y) max.y = p.y;
  }
  [[nodiscard]] bool holds(Vec2 p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y;
  }
  [[nodiscard]] bool empty() const { return max.x < min.x || max.y < min.y; }
  [[nodiscard]] Vec2 size() const { return empty() ? Vec2{} : max - min; }
};

/// A round hole in a shape.
struct RoundHole {
  Vec2 centre;          ///< its middle on the page [mm]
  double diameter = 0;  ///< [mm], above 0

  friend bool operator==(const RoundHole&, const RoundHole&) = default;
};

/// A decoded picture, row 0 on top, channels interleaved. 8-bit sources are widened by 257, so that
/// sample / 65535 equals the 8-bit value / 255 exactly.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;                    ///< 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA
  std::vector<std::uint16_t> samples;  ///< values, width * height * channels of them

  [[nodiscard]] std::uint16_t at(int x, int y, int channel) const {
    return samples[indexOf(x, y, width) * channels + channel];
  }
};

/// A picture for a screen.
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< red, green and blue of each pixel, row 0 on top
};

/// Closed curves, stored one after the other.
struct ClosedCurves {
  std::vector<Vec2f> points;  ///< [mm]
  /// Index of each curve's first point: curve k is points[begin[k]] .. points[begin[k + 1] - 1];
  /// size: curves + 1
  std::vector<int> begin;

  [[nodiscard]] int count() const { return begin.empty() ? 0 : static_cast<int>(begin.size()) - 1; }
  [[nodiscard]] int size(int curve) const {
    return begin[curve + 1] - begin[curve];
  }
};

/// One closed path of beads. The segment from the last point to the first is extruded like any
/// other.
struct Cycle {
  std::vector<Vec2f> points;  ///< points [mm], at least 3; the first is not repeated
  /// Bead width ω at each point [mm]: the room between the half-way lines to the neighbours
  std::vector<float> widths;
};

/// The product of the pipeline: one cycle per connected part of the shape, in printing order.
struct Toolpath {
  std::vector<Cycle> cycles;
  double spacing = 0;  ///< distance τ between neighbouring beads [mm]
};

/// Counts of dislocations, places at which beads begin or end, and estimates of the least that the
/// directions need.
struct Dislocations {
  /// Sum of the sizes of the waves' indices; each dislocation is a U-turn or two
  std::int64_t count = 0;
  /// Singularities of the lines: places round which they turn by half a turn
  std::int64_t singularities = 0;
  /// Estimate of the least count at one constant spacing: the integral of |div t| over the infill,
  /// divided by 2 tau, where t is the bead direction smoothed over 2 tau and |div t| is at most
  /// 1/(2 tau). Beads tau apart end at a rate of div t/tau, and one dislocation ends two of them.
  /// Varying spacing can do with less.
  double bound = 0;
  /// Estimate of the U-turns at the border or at the innermost perimeter: the integral of |t . n|
  /// along it, divided by 2 tau, where n is its normal. Beads that meet it end there, and each
  /// U-turn joins two of them.
  double borderTurns = 0;
};

}  // namespace sillon
