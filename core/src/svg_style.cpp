#include "svg_style.hpp"

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
  value = lowered(newValue);
  weight = newWeight;
}

void Style::declare(std::string_view declarations, std::int64_t weight) {
  split(declarations, ';', [&](std::string_view declaration) {
    const std::size_t colon = declaration.find(':');
    if (colon == std::string_view::npos) return;
    const std::string name = lowered(trimmed(declaration.substr(0, colon)).substr(0, 16));
    std::string_view value = declaration.substr(colon + 1);
    value = trimmed(value.substr(0, value.find('!')));  // without !important, which is not honoured
    if (name == "display") display.set(value, weight);
    if (name == "fill-rule") fillRule.set(value, weight);
  });
}

void Style::add(const Style& other) {
  display.set(other.display.value, other.display.weight);
  fillRule.set(other.fillRule.value, other.fillRule.weight);
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

Style StyleSheet::match(const Node& node) const {
  Style style;
  if (rules_.empty()) return style;
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
  return style;
}

void StyleSheet::addRule(std::string_view selectors, std::string_view declarations) {
  Style probe;
  probe.declare(declarations, 0);
  if (probe.display.weight < 0 && probe.fillRule.weight < 0) return;
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
    const std::int64_t weight = (specificity << 40) + ++order_;
    if (style.display.weight >= 0) style.display.weight = weight;
    if (style.fillRule.weight >= 0) style.fillRule.weight = weight;
    rules_[std::string(selector)].add(style);
  });
}

}  // namespace sillon::svg
