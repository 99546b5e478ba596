#include "geometry/bead_room.hpp"

namespace sillon {
namespace {

constexpr float kRounding = 0.999f;  ///< makes a depth a safe lower bound; far more than rounding errors

}  // namespace

std::optional<NearestBorder> BorderDepth::nearerThan(float depth, Vec2f p) {
  const Vec2f move = p - at_;
  const float spare = known_ - depth;
  if (spare > 0 && dot(move, move) < spare * spare) return std::nullopt;
  const Vec2 at = wide(p);
  at_ = p;
  known_ = kRounding * border_.blockDepth(at);
  if (known_ > depth) return std::nullopt;
  const NearestBorder nearest = border_.nearest(at);
  known_ = kRounding * -nearest.distance;
  if (nearest.distance <= -depth) return std::nullopt;
  return nearest;
}

}  // namespace sillon
