// How deep inside a shape points lie that are asked for one after the other, each near to the one before.
#pragma once

#include <optional>

#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

/// Depth changes by no more than a point moves, so that most points away from the border need no search, and most of
/// these not even a look at the index: on brain it halves both. What it answers does not depend on what was asked
/// before.
class BorderDepth {
 public:
  explicit BorderDepth(const BorderIndex& border) : border_(border) {}

  /// The border nearest to p, unless p lies `depth` [mm] or deeper inside.
  std::optional<NearestBorder> nearerThan(float depth, Vec2f p);

 private:
  const BorderIndex& border_;
  Vec2f at_{};
  float known_ = 0;  ///< at_ lies at least so deep
};

}  // namespace sillon
