// The loop of capsule_rows.cpp for any number of rows at a time. Each source that includes this has its own.
#pragma once

#include "base/capsule_rows.hpp"

namespace sillon {
namespace {

template <class Lanes>
void pixelsBy(const Capsule& capsule, int y, int count, int columns, PixelRuns& runs) {
  using F = typename Lanes::F;
  constexpr float kFar = 1e9f;
  alignas(32) static constexpr float kFollowing[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const F none = Lanes::all(0.0f);
  const F nowhere = Lanes::all(__builtin_nanf(""));
  const F width = Lanes::all(static_cast<float>(columns));
  F row = Lanes::all(static_cast<float>(y)) + Lanes::load(kFollowing);
  for (int k = 0; k < count; k += Lanes::count) {
    F left = Lanes::all(kFar);
    F right = Lanes::all(-kFar);
    // Where a row meets nothing x is no number, which min and max pass over.
    for (int d = 0; d < 2; ++d) {
      const F x = Lanes::all(capsule.discs[d].centre.x);
      const F dy = row - Lanes::all(capsule.discs[d].centre.y);
      const F half = Lanes::sqrt(Lanes::all(capsule.discs[d].radius * capsule.discs[d].radius) - dy * dy);
      left = Lanes::min(x - half, left);
      right = Lanes::max(x + half, right);
    }
    for (int e = 0; e < 2; ++e) {
      const auto& edge = capsule.edges[e];
      const F rise = row - Lanes::all(edge.low);
      const F x = Lanes::select((rise > none) & (row < Lanes::all(edge.high)),
                                Lanes::all(edge.x) + Lanes::all(edge.slope) * rise, nowhere);
      left = Lanes::min(x, left);
      right = Lanes::max(x, right);
    }
    const auto fromEnd = Lanes::toInt(width - Lanes::min(Lanes::max(left, none), width));
    Lanes::store(runs.begin + k, Lanes::all(static_cast<std::int32_t>(columns)) - fromEnd);
    Lanes::store(runs.end + k, Lanes::toInt(Lanes::min(Lanes::max(right + Lanes::all(1.0f), none), width)));
    row = row + Lanes::all(static_cast<float>(Lanes::count));
  }
}

}  // namespace
}  // namespace sillon
