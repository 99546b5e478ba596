// Elements of a drawing, and the names that they refer to.
#pragma once

#include <cstddef>
#include <optional>
#include <rapidxml/rapidxml.hpp>
#include <string>
#include <string_view>

#include "input/svg.hpp"
#include "input/svg/svg_reader.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

// Elements of an SVG document, in RapidXML's form.

using Node = rapidxml::xml_node<>;

/// Returns the local name of an SVG element; empty for text, comments and, after resolveNamespaces, foreign elements.
inline std::string_view elementName(const Node& node) {
  if (node.type() != rapidxml::node_element) return {};
  return {node.name(), node.name_size()};
}

inline std::optional<std::string_view> attribute(const Node& node, std::string_view name) {
  const auto* found = node.first_attribute(name.data(), name.size());
  if (!found) return std::nullopt;
  return std::string_view(found->value(), found->value_size());
}

inline std::optional<std::string_view> hrefOf(const Node& node) {
  const std::optional<std::string_view> href = attribute(node, "href");
  return href ? href : attribute(node, "xlink:href");
}

// Entities of a DOCTYPE: Illustrator writes <!ENTITY st0 "fill:none;"> and style="&st0;".

/// Returns the text with its own general entities replaced, or an empty string if it declares none. An entity may only
/// refer to entities declared before it. Throws Refused if the text would be longer than `maxBytes`, or has too many
/// entities.
std::string withEntities(std::string_view text, std::size_t maxBytes);

// Namespaces: elements of SVG are recognised with any prefix, https://www.w3.org/TR/xml-names/.

/// Reduces the names of SVG elements to local names, empties all other names, and renames each href of XLink to
/// `xlink:href`. Throws Refused if the root is no <svg>, or if there are too many namespaces.
void resolveNamespaces(Node& root);

// Nesting: a text is checked before RapidXML reads it, because RapidXML is recursive.

inline constexpr int kMaxDepth = 200;  ///< levels of elements, including those that <use> adds; each level costs stack

/// Checks that a text nests as XML does. Throws Refused if it is no well-formed XML, or nested deeper than kMaxDepth.
/// \return the text with character references for white space that stands alone between tags in a <text>: RapidXML
/// would drop it, although it separates words. Empty if there is none.
std::string checkNesting(std::string_view text);

// Drawing: elements become areas, from the root downwards.

inline constexpr std::size_t kMostUnread = 8;  ///< largest size of DrawingFacts::unread

/// Draws the elements of a document.
/// \param[out] current  the element that was being read when reading stopped; null outside of elements.
/// Throws Refused.
SvgPainting drawElements(const Node& root, const SvgOptions& options, const Node*& current);

}  // namespace sillon::svg
