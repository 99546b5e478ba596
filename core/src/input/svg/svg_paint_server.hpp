// Gradients and patterns as one paint each: https://www.w3.org/TR/SVG2/pservers.html.
#pragma once

#include <optional>
#include <string_view>
#include <unordered_map>

#include "input/svg/svg_node.hpp"
#include "input/svg/svg_paint.hpp"
#include "input/svg/svg_style.hpp"
#include "input/svg/svg_work.hpp"

namespace sillon::svg {

using Ids = std::unordered_map<std::string_view, const Node*>;

/// A gradient is as opaque as its most opaque stop, and black where all its stops are; nothing: `id` names neither.
/// \param current  currentColor. Throws Refused: too much.
std::optional<Paint> serverPaint(std::string_view id, const Ids& ids, const StyleSheet& styles, const Paint& current,
                                 Work& work);

}  // namespace sillon::svg
