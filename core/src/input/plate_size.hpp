// Limits on the size of a plate.
#pragma once

#include <limits>
#include <optional>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

inline constexpr double kBytesPerCell = 120;  ///< that a plate takes while it is made, at most

/// Cells of half a spacing that a plate takes. \param size  of its outline's box [mm]. \param spacing  tau [mm].
double cellsOf(Vec2 size, double spacing);

/// Why a plate cannot be made, with the spacing and the size from which on it can; nothing if it can. TooLarge, or
/// OutOfMemory where `freeBytes` decides.
/// \param freeBytes  of memory that it may take.
std::optional<Error> plateTooLarge(Vec2 size, double spacing,
                                   double freeBytes = std::numeric_limits<double>::infinity());

}  // namespace sillon
