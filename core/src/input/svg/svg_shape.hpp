// Outlines of the elements that have one: paths and basic shapes.
#pragma once

#include <string_view>

#include "input/svg/svg_length.hpp"
#include "input/svg/svg_node.hpp"
#include "input/svg/svg_path.hpp"

namespace sillon::svg {

/// Whether elements of this name have an outline.
bool isShape(std::string_view name);

/// \param view  what percentages refer to, in user units. \return false: it has no area, and no stroke either.
/// Throws Refused.
bool outlineShape(Outliner& out, const Node& node, Vec2 view, const UserUnits& units);

}  // namespace sillon::svg
