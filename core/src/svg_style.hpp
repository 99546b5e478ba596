// The little of CSS that decides what an SVG element fills: `display` and `fill-rule`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "svg_node.hpp"

namespace sillon::svg {

/// What a property may come from: the last of the most specific wins.
struct Declared {
  std::string value;
  std::int64_t weight = -1;

  void set(std::string_view newValue, std::int64_t newWeight);
};

struct Style {
  Declared display;
  Declared fillRule;

  /// \param declarations  as in an attribute `style`.
  void declare(std::string_view declarations, std::int64_t weight);
  void add(const Style& other);
};

/// Rules of <style> elements whose selector is *, a name, a class, an id, or a name with a class or id.
class StyleSheet {
 public:
  /// \param text  of a <style> element; rules that say nothing of both properties, and what is no CSS, are passed over.
  void add(std::string_view text);
  [[nodiscard]] Style match(const Node& node) const;

 private:
  void addRule(std::string_view selectors, std::string_view declarations);

  std::unordered_map<std::string, Style> rules_;
  std::int64_t order_ = 0;
};

}  // namespace sillon::svg
