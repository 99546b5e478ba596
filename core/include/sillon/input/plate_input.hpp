// Shape and directions of one plate, as the pipeline takes them.
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Pictures to bead directions and direction modes (Sec. 4).

/// Bead direction per texel, stretched over the page; row 0 on top.
struct DirectionMap {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> angle;  ///< angle / 65535 * pi - pi/2 [rad], counter-clockwise from +x

  friend bool operator==(const DirectionMap&, const DirectionMap&) = default;
};

/// Mode per texel, stretched over the page; row 0 on top. 1 x 1 for a whole plate.
struct ModeMap {
  int width = 0;
  int height = 0;
  std::vector<DirectionMode> mode;

  friend bool operator==(const ModeMap&, const ModeMap&) = default;
};

/// Exact for Angle; Rotation and Tangent are off by at most half a unit, 0.0014 degrees.
/// \return InvalidArgument for an image without pixels, or for tangents without red and green.
Result<DirectionMap> directionMap(const Image& image, DirectionEncoding encoding);
/// 1 x 1 map, off by at most 0.0014 degrees.
/// \param degrees  bead direction counter-clockwise from +x; any finite angle.
/// \return InvalidArgument for an angle that is not finite.
Result<DirectionMap> uniformDirection(double degrees);

/// Grey 0, 1/3, 2/3, 1 (nearest) is parallel, orthogonal, smoothest, constrained.
/// \return InvalidArgument for an image without pixels.
Result<ModeMap> modeMap(const Image& image);
ModeMap uniformMode(DirectionMode mode);

// The decoded inputs of one plate.

struct PlateInput {
  Shape shape;
  DirectionMap directions;
  ModeMap modes;
  /// Tones depend on the directions: beads keep to them more closely than to even gaps
  bool showsPictures = false;
};

}  // namespace sillon
