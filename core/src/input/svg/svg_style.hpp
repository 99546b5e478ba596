// Styles and paints of a drawing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "input/shaped_line.hpp"
#include "input/svg/svg_node.hpp"
#include "input/svg/svg_path.hpp"
#include "input/svg/svg_work.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

// Colour names of CSS.

/// Returns the colour with this CSS name, 0xRRGGBB, or nothing if there is none. \param name  in lower case.
std::optional<std::uint32_t> namedColour(std::string_view name);

// Selectors of CSS rules: https://www.w3.org/TR/selectors-4/.

/// Conditions on one element: the `g.a#b` of "svg > g.a#b path".
struct Compound {
  std::string name;                ///< empty for any element
  std::vector<std::string> marks;  ///< ".a", "#b"
  bool child = false;              ///< must be a child of the element before it, not any descendant

  [[nodiscard]] bool fits(const Node& node, Work& work) const;
};

struct Selector {
  std::vector<Compound> elements;  ///< outermost first

  /// Parses a selector. \return nothing if a part of it is not supported.
  static std::optional<Selector> read(std::string_view text);
  [[nodiscard]] bool fits(const Node& node, Work& work) const;
  /// Returns the specificity of CSS: ids, then classes, then names. Below 2^20.
  [[nodiscard]] std::int64_t specificity() const;
};

// CSS properties that decide what an SVG element shows.

inline constexpr std::string_view kPropertyNames[] = {"alignment-baseline",
                                                      "animation",
                                                      "animation-name",
                                                      "baseline-shift",
                                                      "clip-path",
                                                      "clip-rule",
                                                      "color",
                                                      "direction",
                                                      "display",
                                                      "dominant-baseline",
                                                      "fill",
                                                      "fill-opacity",
                                                      "fill-rule",
                                                      "filter",
                                                      "font",
                                                      "font-family",
                                                      "font-feature-settings",
                                                      "font-kerning",
                                                      "font-size",
                                                      "font-size-adjust",
                                                      "font-stretch",
                                                      "font-style",
                                                      "font-variant",
                                                      "font-variant-alternates",
                                                      "font-variant-caps",
                                                      "font-variant-east-asian",
                                                      "font-variant-ligatures",
                                                      "font-variant-numeric",
                                                      "font-variant-position",
                                                      "font-variation-settings",
                                                      "font-weight",
                                                      "letter-spacing",
                                                      "marker",
                                                      "marker-end",
                                                      "marker-mid",
                                                      "marker-start",
                                                      "mask",
                                                      "mask-type",
                                                      "opacity",
                                                      "overflow",
                                                      "stop-color",
                                                      "stop-opacity",
                                                      "stroke",
                                                      "stroke-dasharray",
                                                      "stroke-dashoffset",
                                                      "stroke-linecap",
                                                      "stroke-linejoin",
                                                      "stroke-miterlimit",
                                                      "stroke-opacity",
                                                      "stroke-width",
                                                      "text-anchor",
                                                      "text-decoration",
                                                      "text-decoration-line",
                                                      "text-decoration-style",
                                                      "text-decoration-thickness",
                                                      "text-shadow",
                                                      "text-transform",
                                                      "text-underline-offset",
                                                      "text-underline-position",
                                                      "transform",
                                                      "transform-box",
                                                      "transform-origin",
                                                      "unicode-bidi",
                                                      "vector-effect",
                                                      "visibility",
                                                      "white-space",
                                                      "word-spacing",
                                                      "writing-mode"};

/// Index of a property in kPropertyNames; "fill-rule"_css is the one of that name.
enum class Property : std::size_t {};

consteval Property operator""_css(const char* name, std::size_t size) {
  std::size_t index = 0;
  while (kPropertyNames[index] != std::string_view(name, size)) ++index;  // an unknown name does not compile
  return Property{index};
}

constexpr std::string_view nameOf(Property property) { return kPropertyNames[toSize(property)]; }

/// Value of a property. Of several declarations, the last of the most specific ones wins.
struct Declared {
  std::string value;  ///< trimmed, as written
  std::int64_t weight = -1;

  void set(std::string_view newValue, std::int64_t newWeight);
};

/// Weight of a `style` attribute. Attributes have 0, rules of <style> a weight by their selectors and order; with
/// !important, each ranks again above all others.
inline constexpr std::int64_t kStyleAttribute = std::int64_t{1} << 60;

class Style {
 public:
  /// Returns the declared value; empty if there is none.
  [[nodiscard]] const std::string& value(Property property) const { return of(property).value; }
  /// Returns the declared value in lower case.
  [[nodiscard]] std::string word(Property property) const { return lowered(of(property).value); }
  /// Tells whether CSS declares the property, rather than an attribute of this name.
  [[nodiscard]] bool isCss(Property property) const { return of(property).weight > 0; }
  /// Returns a declared property that changes what is shown and is not read; empty if there is none.
  [[nodiscard]] std::string_view unread() const { return unread_; }
  /// Tells whether unread() moves, turns or scales. That also affects groups.
  [[nodiscard]] bool unreadMoves() const;
  /// Returns "var()" or "calc()" if a value contains one that is not read; otherwise empty.
  [[nodiscard]] std::string_view unreadFunction() const;
  /// Tells whether some value uses the fallback of a var().
  [[nodiscard]] bool fallsBack() const { return fallsBack_; }

  void set(Property property, std::string_view value, std::int64_t weight);
  /// Adds declarations. \param declarations  in the syntax of a `style` attribute.
  void declare(std::string_view declarations, std::int64_t weight);
  void add(const Style& other);
  [[nodiscard]] bool empty() const { return declared_.empty() && unread_.empty(); }
  /// Tells whether any property of letters is declared.
  [[nodiscard]] bool setsLetters() const;
  /// Tells whether only properties of letters are declared; most drawings have no letters.
  [[nodiscard]] bool setsLettersOnly() const;
  /// Returns the cost of applying this style to an element, in bytes read.
  [[nodiscard]] std::size_t cost() const;
  /// Adds to the weight of all declarations.
  void raise(std::int64_t weight);

 private:
  [[nodiscard]] const Declared& of(Property property) const;
  Declared& made(Property property);

  // A list, because an element declares few properties: an array of all took half the time of drawings of many
  // elements.
  std::vector<std::pair<Property, Declared>> declared_;
  std::string_view unread_;
  bool fallsBack_ = false;
};

/// Tells whether declarations or rules may define a custom property.
bool definesProperty(std::string_view css);

/// Rules of <style> elements with supported selectors: names, classes, ids and *, combined by descent.
class StyleSheet {
 public:
  /// Adds a style sheet. Rules without any of these properties, and text that is no CSS, are skipped.
  /// \param text  text of a <style> element.
  /// \param media  media for which it is meant; a sheet that is not for screens counts like @media.
  void add(std::string_view text, std::string_view media);
  /// Collects the declarations of attributes, rules and `style` for an element. Throws Refused if it costs too much.
  [[nodiscard]] Style styleOf(const Node& node, Work& work) const;
  /// Returns the first selector or at-rule, quoted, that is not read and may change what is shown; empty if there is
  /// none.
  [[nodiscard]] const std::string& unread() const { return unread_; }
  /// Returns the same for rules that only change letters.
  [[nodiscard]] const std::string& unreadOfLetters() const { return unreadOfLetters_; }

 private:
  void addRule(std::string_view selectors, std::string_view body);
  void noteAtRule(std::string_view head, std::string_view body);
  void note(std::string_view what, bool lettersOnly = false);
  void match(const Node& node, Style& style, Work& work) const;

  std::unordered_map<std::string, Style> rules_;    // keys: *, a name, .class, #id, name.class, name#id
  std::vector<std::pair<Selector, Style>> nested_;  // rules with other selectors
  std::int64_t order_ = 0;
  std::string unread_;
  std::string unreadOfLetters_;
};

// Paint of an element: its opacity, its colour, and whether it is black, which hides in a mask.

struct Paint {
  double alpha = 1;          ///< 0 if there is no paint
  std::uint64_t colour = 0;  ///< 0xRRGGBB; for gradients and all else that is no colour, higher bits tell them apart
  bool pattern = false;
  bool gradient = false;
  const Node* fading = nullptr;  ///< gradient that is too faint to be seen in some part

  [[nodiscard]] bool black() const { return colour == 0; }
};

/// Makes the colour number of a paint that is no single colour.
/// \param name  tells such paints apart.
/// \param shown  0xRRGGBB
inline std::uint64_t otherColour(std::string_view name, std::uint64_t shown = 0x808080) {
  return shown | std::uint64_t{1} << 24 | static_cast<std::uint64_t>(std::hash<std::string_view>()(name)) << 25;
}

/// Opacity below which paint is invisible. Drawing programs lay such paint over whole pages, to catch clicks.
inline constexpr double kFaintest = 0.02;

/// Properties that change or move letters; a drawing that sets one to another value than the initial one is reported.
inline constexpr std::array kUnreadOfLetters{"direction"_css,
                                             "font-feature-settings"_css,
                                             "font-kerning"_css,
                                             "font-size-adjust"_css,
                                             "font-stretch"_css,
                                             "font-variant"_css,
                                             "font-variant-alternates"_css,
                                             "font-variant-caps"_css,
                                             "font-variant-east-asian"_css,
                                             "font-variant-ligatures"_css,
                                             "font-variant-numeric"_css,
                                             "font-variant-position"_css,
                                             "font-variation-settings"_css,
                                             "font-weight"_css,
                                             "text-decoration-style"_css,
                                             "text-decoration-thickness"_css,
                                             "text-shadow"_css,
                                             "text-transform"_css,
                                             "text-underline-offset"_css,
                                             "text-underline-position"_css,
                                             "unicode-bidi"_css,
                                             "writing-mode"_css};

/// Reference lines of a font, one of which is put at the place of the letters.
enum class BaseLine : unsigned char { Alphabetic, Middle, Central, Hanging, Mathematical, Above, Below };

enum class LetterCase : unsigned char { AsWritten, Upper, Lower };

/// Style of letters; lengths are in user units.
struct LetterStyle {
  double size = 16;  ///< size of the em
  DrawingFont font;
  double anchor = 0;       ///< share of a line before its place: 0 start, 0.5 middle, 1 end
  double spacing = 0;      ///< added between letters
  double wordSpacing = 0;  ///< added to each space
  BaseLine baseLine = BaseLine::Alphabetic;
  std::optional<BaseLine> aligned;  ///< base line of this element alone, instead of baseLine
  double raise = 0;                 ///< height above the line, summed over elements from the <text> downwards
  double raiseInHeights = 0;        ///< raise in multiples of the font's height at em 1
  LetterCase letterCase = LetterCase::AsWritten;
  bool keepsSpaces = false;
  bool slanted = false;
  bool underlined = false, overlined = false, struckThrough = false;
  std::uint32_t unread = 0;  ///< bit k: kUnreadOfLetters[k] is set
};

/// Inherited state, except for `opacity`, which is the product over all ancestors, and `strokeScales`, which is reset.
struct PaintState {
  Paint color;  ///< currentColor
  Paint fill;
  Paint stroke{0};
  /// Paints for context-fill and context-stroke: those of the enclosing <use>. Null outside of a <use>.
  std::shared_ptr<const std::pair<Paint, Paint>> outer;
  double fillOpacity = 1;
  double strokeOpacity = 1;
  double opacity = 1;
  bool visible = true;
  bool strokeScales = true;  ///< width scales with transforms; false for non-scaling-stroke
  FillRule fillRule = FillRule::NonZero;
  FillRule clipRule = FillRule::NonZero;
  LineStroke line;
  LetterStyle letters;

  [[nodiscard]] double fillAlpha() const { return visible ? fill.alpha * fillOpacity * opacity : 0; }
  [[nodiscard]] double strokeAlpha() const { return visible ? stroke.alpha * strokeOpacity * opacity : 0; }
};

/// Functions that look up facts of the document for a style.
struct PaintContext {
  std::function<std::optional<Paint>(std::string_view id)> server;  ///< paint of a gradient or pattern, or nothing
  std::function<double(std::string_view)> length;                   ///< length in user units; NaN if it is none
  std::function<DrawingFont(std::string_view families)> font;
};

/// Applies the declarations of an element to its inherited state. As in CSS, a value that cannot be read counts as
/// missing.
void apply(const Style& style, const PaintContext& context, PaintState& state);

/// Applies the declarations about letters to the inherited style.
void applyLetters(const Style& style, const PaintContext& context, LetterStyle& letters);
/// Raises the letters of an element of a text by its `baseline-shift`.
void raiseLetters(const Style& style, const PaintContext& context, LetterStyle& letters);

/// Reads the finite number at the beginning of a value. \param[out] rest  the text after it, trimmed.
std::optional<double> leadingNumber(std::string_view text, std::string_view& rest);

/// Returns the paint of a gradient's stop.
Paint stopPaint(const Style& style, const Paint& current);

/// Returns the id of "url(#a)", without the #; empty if the value is no such reference.
std::string_view urlOf(std::string_view value);

// Gradients and patterns, each reduced to one paint: https://www.w3.org/TR/SVG2/pservers.html.

using Ids = std::unordered_map<std::string_view, const Node*>;

/// Returns the paint of a gradient or pattern; nothing if `id` names neither. A gradient is as opaque as its most
/// opaque stop, and black if all its stops are.
/// \param current  currentColor. Throws Refused if it costs too much.
std::optional<Paint> serverPaint(std::string_view id, const Ids& ids, const StyleSheet& styles, const Paint& current,
                                 Work& work);

/// Place of a fading gradient.
struct GradientPlace {
  Matrix toWorld;  ///< from user units to mm
  Bounds box;      ///< box of the element that it paints, in user units
  Vec2 viewport;   ///< size that percentages refer to, in user units
  UserUnits units;
  Bounds around;  ///< box in which the result is needed [mm]
};

/// Returns the area in which a gradient is visible, within `around`: there it has a fifth or more of its greatest
/// opacity. Nothing if that cannot be computed; then all of it counts. Throws Refused if it costs too much.
std::optional<FilledPath> seenOfGradient(const Node& gradient, const GradientPlace& place, const Ids& ids,
                                         const StyleSheet& styles, Work& work);

}  // namespace sillon::svg
