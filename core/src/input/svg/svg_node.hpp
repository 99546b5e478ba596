// Elements of an SVG document as RapidXML keeps them.
#pragma once

#include <optional>
#include <string_view>

#include <rapidxml/rapidxml.hpp>

#include "input/svg/svg_reader.hpp"

namespace sillon::svg {

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

}  // namespace sillon::svg
