// Elements of a drawing, and what they name.
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

// Elements of an SVG document as RapidXML keeps them.

using Node = rapidxml::xml_node<>;

/// Local name of an SVG element; empty for text, comments and, after resolveNamespaces, for elements of others.
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

/// The text with its own general entities written out; empty: it has none. Entities hold only those declared before.
/// Throws Refused: the text would be longer than `maxBytes`, or there are too many entities.
std::string withEntities(std::string_view text, std::size_t maxBytes);

// Elements of SVG, whatever prefixes a file gives them: https://www.w3.org/TR/xml-names/.

/// Leaves elements of SVG their local names and all others empty ones, and calls each href of XLink `xlink:href`.
/// Throws Refused: the root is no <svg>, or there are more namespaces than can be.
void resolveNamespaces(Node& root);

// Checks that a text nests as XML does, and not too deep: it is looked over before RapidXML reads it.

inline constexpr int kMaxDepth = 200;  ///< of elements, <use> counted in: each level costs stack

/// Throws Refused: no well-formed XML, or nested deeper than kMaxDepth.
/// \return the text with references for the white space that stands alone between tags in a <text>, which RapidXML
/// would drop although it separates words; empty: there is none.
std::string checkNesting(std::string_view text);

// The elements of a drawing, from the root downwards, as areas.

inline constexpr std::size_t kMostUnread = 8;  ///< of DrawingFacts::unread

/// \param[out] current  the element that was being read when reading stopped; null outside of elements.
/// Throws Refused.
SvgPainting drawElements(const Node& root, const SvgOptions& options, const Node*& current);

}  // namespace sillon::svg
