// The border that outlines and combinations of paths are made of.
#pragma once

#include <vector>

#include "sillon/geometry/outline.hpp"

namespace sillon {

enum class Points { AsGiven, OnGrid };  ///< mm as they are, or whole steps of the grid

/// The pieces with inside on exactly one side, on their left. No pieces if nothing is inside.
/// \param rule  null: inside is where any path is filled. \return TooLarge as resolveOutline.
Result<Outline> borderOf(const std::vector<FilledPath>& paths, const InsideRule* rule, Points points);

}  // namespace sillon
