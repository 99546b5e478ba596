// The elements of a drawing, from the root downwards, as areas.
#pragma once

#include "input/svg/svg_node.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/svg.hpp"

namespace sillon::svg {

/// \param[out] current  the element that was being read when reading stopped; null outside of elements.
/// Throws Refused.
Shape drawElements(const Node& root, const SvgOptions& options, const Node*& current);

}  // namespace sillon::svg
