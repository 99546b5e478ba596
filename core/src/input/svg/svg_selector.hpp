// Selectors of CSS rules: https://www.w3.org/TR/selectors-4/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/svg/svg_node.hpp"
#include "input/svg/svg_work.hpp"

namespace sillon::svg {

/// What one element must have: the `g.a#b` of "svg > g.a#b path".
struct Compound {
  std::string name;                ///< empty: any
  std::vector<std::string> marks;  ///< ".a", "#b"
  bool child = false;              ///< stands directly inside of the element before it, not somewhere inside

  [[nodiscard]] bool fits(const Node& node, Work& work) const;
};

struct Selector {
  std::vector<Compound> elements;  ///< outermost first

  /// \return nothing where a part of the text is not read.
  static std::optional<Selector> read(std::string_view text);
  [[nodiscard]] bool fits(const Node& node, Work& work) const;
  /// As CSS counts: ids, then classes, then names. Below 2^20.
  [[nodiscard]] std::int64_t specificity() const;
};

}  // namespace sillon::svg
