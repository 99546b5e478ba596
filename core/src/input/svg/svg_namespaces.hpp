// Which elements are SVG's, whatever prefixes a file gives them: https://www.w3.org/TR/xml-names/.
#pragma once

#include "input/svg/svg_node.hpp"

namespace sillon::svg {

/// Leaves elements of SVG their local names and all others empty ones, and calls each href of XLink `xlink:href`.
/// Throws Refused: the root is no <svg>, or there are more namespaces than can be.
void resolveNamespaces(Node& root);

}  // namespace sillon::svg
