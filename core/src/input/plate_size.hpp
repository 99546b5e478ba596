// Limits on the size of a plate.
#pragma once

#include <limits>
#include <optional>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

inline constexpr double kBytesPerCell = 120;  ///< upper bound of a plate's memory while it is made [bytes]

/// Estimates the cells of a plate; a cell is half a spacing wide.
/// \param size  size of its outline's box [mm].
/// \param spacing  tau [mm].
double cellsOf(Vec2 size, double spacing);

/// Explains why a plate cannot be made, and names the spacing and the size from which on it can. The error is TooLarge,
/// or OutOfMemory where `freeBytes` decides.
/// \param freeBytes  memory that the plate may take.
/// \return nothing if the plate can be made.
std::optional<Error> plateTooLarge(Vec2 size, double spacing,
                                   double freeBytes = std::numeric_limits<double>::infinity());

}  // namespace sillon
