// The base of a plate as a solid, for those who want their own slicer to print it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// A closed surface, outside on the left of each triangle's edges as seen from there. Every edge
/// between two points belongs to two triangles, in opposite directions.
struct Mesh {
  /// X, y, z on the bed [mm], on the grid of the G-code
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Makes the solid of the base layers, as the G-code places it, with all copies. No elephant's foot
/// is taken off. Whether it fits the bed is not looked at: writeGcode does.
/// \return InvalidArgument (also for a plate without a base), DoesNotFit (in height), EmptyShape,
/// TooLarge.
Result<Mesh> baseBody(const Shape& shape, const Printer& printer, const PrintParams& params);

/// Describes a fault of a mesh in one sentence: a corner that is not a point of it, or a point that
/// is not finite. Empty: nothing.
[[nodiscard]] std::string meshDefect(const Mesh& mesh);

/// Binary STL.
/// \return InvalidArgument as meshDefect tells.
Result<std::string> writeStl(const Mesh& mesh);

/// 3MF with one object, uncompressed. The same bytes for the same mesh.
/// \return InvalidArgument as meshDefect tells.
Result<std::string> write3mf(const Mesh& mesh);

}  // namespace sillon
