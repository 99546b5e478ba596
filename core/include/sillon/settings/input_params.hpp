// What a person may choose about the shape, its directions and its modes.
#pragma once

#include <cstdint>

namespace sillon {

inline constexpr double kDefaultWidth = 80;  ///< page width [mm] of built-in shapes and masks that name none

enum class BuiltinShape { None, Rectangle, RoundedRectangle, Disc };

/// How a picture encodes directions. Colour pictures are read by their luma (Rec. 709) except for tangents; alpha is
/// ignored.
enum class DirectionEncoding {
  Angle,     ///< grey 0..1 is -90..90 degrees, as in the paper
  Rotation,  ///< grey 0..1 is 0..180 degrees, the rotation map of texture tools
  Tangent,  ///< red, green in 0..1 are x, y in -1..1, y up, as in glTF's KHR_materials_anisotropy; neutral is 0 degrees
};

/// What a place asks of its beads.
enum class DirectionMode : std::uint8_t {
  Parallel,     ///< to the nearest border, smoothly
  Orthogonal,   ///< to the nearest border, smoothly
  Smoothest,    ///< whatever bends least
  Constrained,  ///< the direction map
};

}  // namespace sillon
