#include "input/svg/svg_style.hpp"

#include <algorithm>
#include <cstddef>

namespace sillon::svg {
namespace {

std::string withoutComments(std::string_view text) {
  std::string css;
  while (true) {
    const std::size_t begin = text.find("/*");
    css += text.substr(0, begin);
    if (begin == std::string_view::npos) return css;
    const std::size_t end = text.find("*/", begin + 2);
    if (end == std::string_view::npos) return css;
    css += ' ';
    text.remove_prefix(end + 2);
  }
}

}  // namespace

void Declared::set(std::string_view newValue, std::int64_t newWeight) {
  if (newWeight < weight) return;
  value = trimmed(newValue);
  weight = newWeight;
}

void Style::declare(std::string_view declarations, std::int64_t weight) {
  split(declarations, ';', [&](std::string_view declaration) {
    const std::size_t colon = declaration.find(':');
    if (colon == std::string_view::npos) return;
    const std::string name = lowered(trimmed(declaration.substr(0, colon)).substr(0, 32));
    const auto found = std::find(kPropertyNames.begin(), kPropertyNames.end(), name);
    if (found == kPropertyNames.end()) return;
    std::string_view value = declaration.substr(colon + 1);
    const std::size_t mark = value.find('!');
    const bool important = mark != std::string_view::npos && lowered(value.substr(mark)).find("important") < 12;
    set(static_cast<Property>(found - kPropertyNames.begin()), value.substr(0, mark),
        weight + (important ? 2 * kStyleAttribute : 0));
  });
}

void Style::add(const Style& other) {
  for (std::size_t k = 0; k < declared_.size(); ++k) {
    if (other.declared_[k].weight >= 0) declared_[k].set(other.declared_[k].value, other.declared_[k].weight);
  }
}

bool Style::empty() const {
  return std::all_of(declared_.begin(), declared_.end(), [](const Declared& d) { return d.weight < 0; });
}

void Style::raise(std::int64_t weight) {
  for (Declared& d : declared_) {
    if (d.weight >= 0) d.weight += weight;
  }
}

void StyleSheet::add(std::string_view text) {
  const std::string css = withoutComments(text);
  std::string_view rest = css;
  while (true) {
    rest = trimmed(rest);
    const std::size_t open = rest.find_first_of("{;");
    if (open == std::string_view::npos) return;
    const std::string_view head = trimmed(rest.substr(0, open));
    if (rest[open] == ';') {  // @import and the like
      rest.remove_prefix(open + 1);
      continue;
    }
    std::size_t end = open + 1;
    for (int depth = 1; depth > 0 && end < rest.size(); ++end) {
      if (rest[end] == '{') ++depth;
      if (rest[end] == '}') --depth;
    }
    if (!startsWith(head, "@")) {
      const std::string_view body = rest.substr(open + 1, end - open - 1);
      addRule(head, body.substr(0, body.find('}')));
    }
    rest.remove_prefix(end);
  }
}

Style StyleSheet::styleOf(const Node& node) const {
  Style style;
  for (const auto* a = node.first_attribute(); a; a = a->next_attribute()) {
    const std::string_view name(a->name(), a->name_size());
    const auto found = std::find(kPropertyNames.begin(), kPropertyNames.end(), name);
    if (found == kPropertyNames.end()) continue;
    style.set(static_cast<Property>(found - kPropertyNames.begin()), {a->value(), a->value_size()}, 0);
  }
  if (!rules_.empty()) match(node, style);
  style.declare(attribute(node, "style").value_or(""), kStyleAttribute);
  return style;
}

void StyleSheet::match(const Node& node, Style& style) const {
  const auto look = [&](const std::string& selector) {
    const auto found = rules_.find(selector);
    if (found != rules_.end()) style.add(found->second);
  };
  const std::string name(elementName(node));
  look("*");
  look(name);
  std::string_view classes = attribute(node, "class").value_or("");
  while (!(classes = trimmed(classes)).empty()) {
    const auto* end = std::find_if(classes.data(), classes.data() + classes.size(), isSpace);
    const std::string token(classes.data(), end);
    classes.remove_prefix(token.size());
    look('.' + token);
    look(name + '.' + token);
  }
  if (const auto id = attribute(node, "id")) {
    const std::string token(*id);
    look('#' + token);
    look(name + '#' + token);
  }
}

void StyleSheet::addRule(std::string_view selectors, std::string_view declarations) {
  Style probe;
  probe.declare(declarations, 0);
  if (probe.empty()) return;
  split(selectors, ',', [&](std::string_view selector) {
    selector = trimmed(selector);
    if (selector.empty() || selector.find_first_of(" \t\r\n>+~:[") != std::string_view::npos) return;
    const std::size_t mark = selector.find_first_of(".#");
    const bool hasMark = mark != std::string_view::npos;
    if (hasMark && selector.find_first_of(".#", mark + 1) != std::string_view::npos) return;
    if (hasMark && mark == 1 && selector[0] == '*') selector.remove_prefix(1);
    // As CSS counts: ids, then classes, then names, then order.
    std::int64_t specificity = hasMark ? (selector.find('#') != std::string_view::npos ? 4 : 2) : 0;
    if (selector[0] != '.' && selector[0] != '#' && selector[0] != '*') specificity += 1;
    Style style = probe;
    style.raise((specificity << 40) + ++order_);
    rules_[std::string(selector)].add(style);
  });
}

}  // namespace sillon::svg
