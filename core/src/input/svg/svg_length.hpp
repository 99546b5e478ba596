// Lengths with units: https://www.w3.org/TR/SVG2/coords.html#Units.
#pragma once

#include <optional>
#include <string_view>

#include "input/svg/svg_node.hpp"
#include "sillon/base/types.hpp"

namespace sillon::svg {

inline constexpr double kMmPerPx = 25.4 / 96;

struct Length {
  double value = 0;
  double mmPerUnit = 0;  ///< 0: user units
  bool percent = false;
};

/// Of a CSS length, in lower case; 0: no unit, user units. Nothing for an unknown one. em and ex: of a 16 px font.
std::optional<double> mmPerUnit(std::string_view unit);

/// Nothing for a missing attribute and for "auto". Throws Refused: an unknown unit.
std::optional<Length> lengthOf(const Node& node, const char* name);

/// Lengths in user units of the drawing. Throws Refused where an attribute cannot be read.
struct UserUnits {
  double mm = kMmPerPx;  ///< of one

  /// \param full  100 % in user units
  [[nodiscard]] double of(const Node& node, const char* name, double full, double missing) const;
  /// Throws Refused if it is negative, too.
  [[nodiscard]] double positive(const Node& node, const char* name, double full, double missing) const;
  /// rx and ry; a missing one is like the other. \param full  100 % of either.
  [[nodiscard]] Vec2 radii(const Node& node, Vec2 full) const;
  /// Of a style; NaN for what is none.
  [[nodiscard]] double ofStyle(std::string_view text, double full) const;
};

}  // namespace sillon::svg
