// Points and sizes of shapes that Sillon makes itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/refused.hpp"
#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

inline constexpr double kMaxSize = 10'000;  ///< largest side of a page [mm]

// Rounds to 1 nm, so that every platform gets the same bytes: differences in the last digit of libm are far below 1 nm.
// Adding 0 turns -0 into 0.
inline double snapped(double mm) { return std::round(mm * 1e6) / 1e6 + 0.0; }
inline Vec2 snapped(Vec2 p) { return {snapped(p.x), snapped(p.y)}; }

inline bool validSize(double mm) { return snapped(mm) > 0 && mm <= kMaxSize; }  // false for NaN

/// \param name  setting in full
inline Error sizeError(std::string_view name, double mm) {
  return refusedArgument("SizeOutOfRange", {{"name", name}, {"value", mm}, {"most", kMaxSize}});
}

inline void dropRepeatedPoints(Ring& ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
}

/// Makes a circle, counter-clockwise, accurate within 0.001 mm.
Ring circleRing(Vec2 centre, double diameter);

/// Moves every point of a shape; its page stays.
/// \param move  function from a point to its new place.
template <class Move>
void movePoints(Shape& shape, const Move& move) {
  for (FilledPath& path : shape.paths) {
    for (Ring& ring : path.rings) {
      for (Vec2& point : ring) point = move(point);
    }
  }
}

}  // namespace sillon
