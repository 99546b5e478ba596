// Shape and directions of one plate, as the pipeline takes them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Files that a project names, handed over by whoever keeps them.

/// An input: the bytes of a file, or a picture decoded elsewhere.
using InputFile = std::variant<std::string, Image>;

/// Hands over the file that a project names.
/// \param what  role of the file, for messages: "shape", "direction picture", "font".
using ReadInput =
    std::function<Result<InputFile>(const std::string& name, const std::string& what)>;

// Shape and directions of one plate, as the pipeline takes them.

// Maps of bead directions and direction modes, decoded from pictures (Sec. 4).

/// Bead direction per texel, stretched over the page; row 0 on top.
struct DirectionMap {
  int width = 0;
  int height = 0;
  /// Values; `angle` / 65535 * pi - pi/2 is the direction [rad], counter-clockwise from +x
  std::vector<std::uint16_t> angle;

  friend bool operator==(const DirectionMap&, const DirectionMap&) = default;
};

/// Mode per texel, stretched over the page; row 0 on top. 1 x 1 for a whole plate.
struct ModeMap {
  int width = 0;
  int height = 0;
  std::vector<DirectionMode> mode;

  friend bool operator==(const ModeMap&, const ModeMap&) = default;
};

/// Decodes a picture of directions. Angle is exact; Rotation and Tangent are off by at most half a
/// unit, 0.0014 degrees.
/// \return InvalidArgument for an image without pixels, or for tangents without red and green.
Result<DirectionMap> directionMap(const Image& image, DirectionEncoding encoding);
/// Makes a 1 x 1 map of one direction, off by at most 0.0014 degrees.
/// \param degrees  bead direction counter-clockwise from +x; any finite angle.
/// \return InvalidArgument for an angle that is not finite.
Result<DirectionMap> uniformDirection(double degrees);

/// Decodes a picture of modes: grey 0, 1/3, 2/3, 1 (nearest) is parallel, orthogonal, smoothest,
/// constrained.
/// \return InvalidArgument for an image without pixels.
Result<ModeMap> modeMap(const Image& image);
/// Makes a 1 x 1 map of one mode.
ModeMap uniformMode(DirectionMode mode);

// The decoded inputs of one plate.

struct PlateInput {
  Shape shape;
  DirectionMap directions;
  ModeMap modes;
  /// Tones of pictures depend on the directions, so that beads keep to them more closely than to
  /// even gaps
  bool showsPictures = false;
};

}  // namespace sillon
