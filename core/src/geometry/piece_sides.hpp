// What lies beside the pieces of a border.
#pragma once

#include <optional>
#include <vector>

#include "geometry/winding.hpp"

namespace sillon {

/// Whether the inside lies on the left and on the right of a piece, seen from a to b.
struct Sides {
  bool left = false;
  bool right = false;
};

/// \param pieces  of the edges of paths, meeting at their ends only; box holds them
/// \param rule    null: inside is where any path is filled
/// \return of each piece; of those with the same ends, the first one's are told and the others have no inside on
///         either. None if that would take too long.
std::optional<std::vector<Sides>> sidesOf(const std::vector<PathEdge>& pieces, const Bounds& box,
                                          const std::vector<FilledPath>& paths, const InsideRule* rule);

}  // namespace sillon
