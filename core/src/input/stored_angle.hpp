// Storage of directions in maps: 16 bits over half a turn.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace sillon {

/// Encodes a direction. \param halfTurns  any angle; it is reduced to -1/2..1/2 first.
inline std::uint16_t storedAngle(double halfTurns) {
  const double turned = halfTurns - std::floor(halfTurns + 0.5);
  return static_cast<std::uint16_t>(std::lround((turned + 0.5) * 65535));
}

/// Decodes a direction. \return the angle [rad].
inline double angleOf(std::uint16_t stored) { return (stored / 65535.0 - 0.5) * std::numbers::pi; }

}  // namespace sillon
