// What an element is painted with, as far as it matters where one bead is like the next: whether it is seen at all,
// whether it is black, which hides in a mask, and whether its colour is that of others.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "input/svg/svg_stroke.hpp"
#include "input/svg/svg_style.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

struct Paint {
  double alpha = 1;          ///< 0: none
  std::uint64_t colour = 0;  ///< 0xRRGGBB, or another number for each name and each gradient
  bool pattern = false;
  bool gradient = false;

  [[nodiscard]] bool black() const { return colour == 0; }
};

/// Added to the colour of a name or a gradient.
inline constexpr std::uint64_t kOther = 0x1000000;

/// Nobody sees less. Drawing programs lay it over whole pages, to catch clicks.
inline constexpr double kFaintest = 0.02;

/// Inherited from element to element, but for `opacity`, which is the product of all around, and `strokeScales`.
struct PaintState {
  Paint color;  ///< currentColor
  Paint fill;
  Paint stroke{0};
  double fillOpacity = 1;
  double strokeOpacity = 1;
  double opacity = 1;
  bool visible = true;
  bool strokeScales = true;  ///< with transforms; false: it is as wide as without them
  FillRule fillRule = FillRule::NonZero;
  FillRule clipRule = FillRule::NonZero;
  Stroke line;

  [[nodiscard]] double fillAlpha() const { return visible ? fill.alpha * fillOpacity * opacity : 0; }
  [[nodiscard]] double strokeAlpha() const { return visible ? stroke.alpha * strokeOpacity * opacity : 0; }
};

/// What a style needs to know of the document.
struct PaintContext {
  std::function<std::optional<Paint>(std::string_view id)> server;  ///< a gradient or pattern; nothing: it is neither
  std::function<double(std::string_view)> length;                   ///< in user units; NaN: not a length
};

/// Lays the declarations of an element over what it inherits. As in CSS, a value that cannot be read counts as missing.
void apply(const Style& style, const PaintContext& context, PaintState& state);

/// Of a stop of a gradient.
Paint stopPaint(const Style& style, const Paint& current);

/// "#a" of "url(#a)", without the #; empty: no such reference.
std::string_view urlOf(std::string_view value);

}  // namespace sillon::svg
