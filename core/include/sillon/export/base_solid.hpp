// The base of a plate as a solid, for printing it with another slicer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// A closed surface of triangles, counter-clockwise as seen from outside. Every edge between two
/// points belongs to two triangles, in opposite directions.
struct Mesh {
  /// Points x, y, z on the bed [mm], on the grid of the G-code
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Makes the solid of the base layers, placed as in the G-code, with all copies. No elephant's foot
/// is taken off. The edges of the bed are not checked here, but by writeGcode.
/// \return InvalidArgument (also for a plate without a base), DoesNotFit (in height), EmptyShape,
/// TooLarge.
Result<Mesh> baseBody(const Shape& shape, const Printer& printer, const PrintParams& params);

/// Refuses a mesh that has a corner which is not a point of it, or a point that is not finite.
std::optional<Error> meshDefect(const Mesh& mesh);

/// Writes a mesh as binary STL.
/// \return InvalidArgument where meshDefect finds a fault.
Result<std::string> writeStl(const Mesh& mesh);

/// Writes a mesh as 3MF with one object, uncompressed. The same mesh gives the same bytes.
/// \return InvalidArgument where meshDefect finds a fault.
Result<std::string> write3mf(const Mesh& mesh);

}  // namespace sillon
