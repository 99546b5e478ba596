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

#include "input/svg/svg_node.hpp"
#include "input/svg/svg_path.hpp"
#include "input/svg/svg_work.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/shaped_line.hpp"

namespace sillon::svg {

// The words CSS knows for colours.

/// The colour of this name in CSS, 0xRRGGBB; nothing: it has none. \param name  in lower case.
std::optional<std::uint32_t> namedColour(std::string_view name);

// Selectors of CSS rules: https://www.w3.org/TR/selectors-4/.

/// Conditions on one element: the `g.a#b` of "svg > g.a#b path".
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
  /// Weight as CSS counts it: ids, then classes, then names. Below 2^20.
  [[nodiscard]] std::int64_t specificity() const;
};

// The CSS that decides what an SVG element shows.

/// In the order of kPropertyNames.
enum class Property : std::size_t {
  AlignmentBaseline,
  Animation,
  AnimationName,
  BaselineShift,
  ClipPath,
  ClipRule,
  Color,
  Direction,
  Display,
  DominantBaseline,
  Fill,
  FillOpacity,
  FillRule,
  Filter,
  Font,
  FontFamily,
  FontFeatureSettings,
  FontKerning,
  FontSize,
  FontSizeAdjust,
  FontStretch,
  FontStyle,
  FontVariant,
  FontVariantAlternates,
  FontVariantCaps,
  FontVariantEastAsian,
  FontVariantLigatures,
  FontVariantNumeric,
  FontVariantPosition,
  FontVariationSettings,
  FontWeight,
  LetterSpacing,
  Marker,
  MarkerEnd,
  MarkerMid,
  MarkerStart,
  Mask,
  MaskType,
  Opacity,
  Overflow,
  StopColor,
  StopOpacity,
  Stroke,
  StrokeDasharray,
  StrokeDashoffset,
  StrokeLinecap,
  StrokeLinejoin,
  StrokeMiterlimit,
  StrokeOpacity,
  StrokeWidth,
  TextAnchor,
  TextDecoration,
  TextDecorationLine,
  TextDecorationStyle,
  TextDecorationThickness,
  TextShadow,
  TextTransform,
  TextUnderlineOffset,
  TextUnderlinePosition,
  Transform,
  TransformBox,
  TransformOrigin,
  UnicodeBidi,
  VectorEffect,
  Visibility,
  WhiteSpace,
  WordSpacing,
  WritingMode,
};
inline constexpr std::array<std::string_view, 68> kPropertyNames{"alignment-baseline",
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

constexpr std::string_view nameOf(Property property) { return kPropertyNames[static_cast<std::size_t>(property)]; }

/// What a property may come from: the last of the most specific wins.
struct Declared {
  std::string value;  ///< trimmed, as written
  std::int64_t weight = -1;

  void set(std::string_view newValue, std::int64_t newWeight);
};

/// Weights: attributes 0, rules of <style> by their selectors and order, `style` attributes, each of them again above
/// all others where it is !important.
inline constexpr std::int64_t kStyleAttribute = std::int64_t{1} << 60;

class Style {
 public:
  /// Empty where nothing is declared.
  [[nodiscard]] const std::string& value(Property property) const { return of(property).value; }
  /// In lower case.
  [[nodiscard]] std::string word(Property property) const { return lowered(of(property).value); }
  /// Whether CSS says it, not an attribute of this name.
  [[nodiscard]] bool isCss(Property property) const { return of(property).weight > 0; }
  /// A property that changes what is shown and is not read; empty: none is declared.
  [[nodiscard]] std::string_view unread() const { return unread_; }
  /// Whether that moves, turns or scales, which groups do, too.
  [[nodiscard]] bool unreadMoves() const;
  /// "var()" or "calc()" where a value has one that is not read; else empty.
  [[nodiscard]] std::string_view unreadFunction() const;
  /// Whether a value is what var() gives where its custom property is not defined.
  [[nodiscard]] bool fallsBack() const { return fallsBack_; }

  void set(Property property, std::string_view value, std::int64_t weight);
  /// \param declarations  as in an attribute `style`.
  void declare(std::string_view declarations, std::int64_t weight);
  void add(const Style& other);
  [[nodiscard]] bool empty() const { return declared_.empty() && unread_.empty(); }
  /// Tells whether anything changes of letters.
  [[nodiscard]] bool setsLetters() const;
  /// Tells whether nothing changes but letters, of which most drawings have none.
  [[nodiscard]] bool setsLettersOnly() const;
  /// Cost of laying this over an element, in bytes that are read.
  [[nodiscard]] std::size_t cost() const;
  /// Adds to the weight of all that is declared.
  void raise(std::int64_t weight);

 private:
  [[nodiscard]] const Declared& of(Property property) const;
  Declared& made(Property property);

  // Few of each element: a place for every property took half the time of drawings of many elements.
  std::vector<std::pair<Property, Declared>> declared_;
  std::string_view unread_;
  bool fallsBack_ = false;
};

/// Whether declarations or rules may define a custom property.
bool definesProperty(std::string_view css);

/// Rules of <style> elements whose selectors are made of names, classes, ids and *, each inside of the one before it.
class StyleSheet {
 public:
  /// \param text  of a <style> element; rules that say nothing of these properties, and what is no CSS, are passed
  /// over.
  /// \param media  for which it is meant; others than all and screens count as in @media.
  void add(std::string_view text, std::string_view media);
  /// What attributes, rules and `style` declare of an element. Throws Refused: more is compared than can be.
  [[nodiscard]] Style styleOf(const Node& node, Work& work) const;
  /// The first selector or at-rule, in quotes, that is not read and may change what is shown; empty: all is read.
  [[nodiscard]] const std::string& unread() const { return unread_; }
  /// The same of those that change letters alone.
  [[nodiscard]] const std::string& unreadOfLetters() const { return unreadOfLetters_; }

 private:
  void addRule(std::string_view selectors, std::string_view body);
  void noteAtRule(std::string_view head, std::string_view body);
  void note(std::string_view what, bool lettersOnly = false);
  void match(const Node& node, Style& style, Work& work) const;

  std::unordered_map<std::string, Style> rules_;    // whose selector is *, a name, .class, #id, name.class, name#id
  std::vector<std::pair<Selector, Style>> nested_;  // of other selectors
  std::int64_t order_ = 0;
  std::string unread_;
  std::string unreadOfLetters_;
};

// The paint of an element: whether it is seen at all, whether it is black, which hides in a mask, and its colour.

struct Paint {
  double alpha = 1;          ///< 0: none
  std::uint64_t colour = 0;  ///< 0xRRGGBB, and above it another number for each gradient and all else that is no colour
  bool pattern = false;
  bool gradient = false;
  const Node* fading = nullptr;  ///< gradient that becomes too faint to be seen somewhere

  [[nodiscard]] bool black() const { return colour == 0; }
};

/// Stands for all that is no one colour. \param name  tells it apart. \param shown  0xRRGGBB
inline std::uint64_t otherColour(std::string_view name, std::uint64_t shown = 0x808080) {
  return shown | std::uint64_t{1} << 24 | static_cast<std::uint64_t>(std::hash<std::string_view>()(name)) << 25;
}

/// Nobody sees less. Drawing programs lay it over whole pages, to catch clicks.
inline constexpr double kFaintest = 0.02;

/// Properties that change or move letters and are told where they are not what letters are without them.
inline constexpr std::array kUnreadOfLetters{Property::Direction,
                                             Property::FontFeatureSettings,
                                             Property::FontKerning,
                                             Property::FontSizeAdjust,
                                             Property::FontStretch,
                                             Property::FontVariant,
                                             Property::FontVariantAlternates,
                                             Property::FontVariantCaps,
                                             Property::FontVariantEastAsian,
                                             Property::FontVariantLigatures,
                                             Property::FontVariantNumeric,
                                             Property::FontVariantPosition,
                                             Property::FontVariationSettings,
                                             Property::FontWeight,
                                             Property::TextDecorationStyle,
                                             Property::TextDecorationThickness,
                                             Property::TextShadow,
                                             Property::TextTransform,
                                             Property::TextUnderlineOffset,
                                             Property::TextUnderlinePosition,
                                             Property::UnicodeBidi,
                                             Property::WritingMode};

/// Lines of a font, one of which lies on the place of the letters.
enum class BaseLine : unsigned char { Alphabetic, Middle, Central, Hanging, Mathematical, Above, Below };

enum class LetterCase : unsigned char { AsWritten, Upper, Lower };

/// Letters of a text, in user units.
struct LetterStyle {
  double size = 16;  ///< of the em
  DrawingFont font;
  double anchor = 0;       ///< share of a line that lies before its place: 0 start, 0.5 middle, 1 end
  double spacing = 0;      ///< added between letters
  double wordSpacing = 0;  ///< added to spaces
  BaseLine baseLine = BaseLine::Alphabetic;
  std::optional<BaseLine> aligned;  ///< of the element alone, instead of baseLine
  double raise = 0;                 ///< above the line, by all elements from the <text> downwards
  double raiseInHeights = 0;        ///< the same, where it is in heights of a font whose em is 1
  LetterCase letterCase = LetterCase::AsWritten;
  bool keepsSpaces = false;
  bool slanted = false;
  bool underlined = false, overlined = false, struckThrough = false;
  std::uint32_t unread = 0;  ///< bits, in the order of kUnreadOfLetters
};

/// Inherited from element to element, but for `opacity`, which is the product of all around, and `strokeScales`.
struct PaintState {
  Paint color;  ///< currentColor
  Paint fill;
  Paint stroke{0};
  /// context-fill and context-stroke: those of the <use> around, which all within share. Null: none is around.
  std::shared_ptr<const std::pair<Paint, Paint>> outer;
  double fillOpacity = 1;
  double strokeOpacity = 1;
  double opacity = 1;
  bool visible = true;
  bool strokeScales = true;  ///< with transforms; false: it is as wide as without them
  FillRule fillRule = FillRule::NonZero;
  FillRule clipRule = FillRule::NonZero;
  Stroke line;
  LetterStyle letters;

  [[nodiscard]] double fillAlpha() const { return visible ? fill.alpha * fillOpacity * opacity : 0; }
  [[nodiscard]] double strokeAlpha() const { return visible ? stroke.alpha * strokeOpacity * opacity : 0; }
};

/// Facts of the document that a style needs.
struct PaintContext {
  std::function<std::optional<Paint>(std::string_view id)> server;  ///< a gradient or pattern; nothing: it is neither
  std::function<double(std::string_view)> length;                   ///< in user units; NaN: not a length
  std::function<DrawingFont(std::string_view families)> font;
};

/// Lays the declarations of an element over what it inherits. As in CSS, a value that cannot be read counts as missing.
void apply(const Style& style, const PaintContext& context, PaintState& state);

/// Lays what an element declares of its letters over what it inherits.
void applyLetters(const Style& style, const PaintContext& context, LetterStyle& letters);
/// Raises the letters of an element of a text as its `baseline-shift` says.
void raiseLetters(const Style& style, const PaintContext& context, LetterStyle& letters);

/// The finite number that a value begins with. \param[out] rest  the text after it, trimmed.
std::optional<double> leadingNumber(std::string_view text, std::string_view& rest);

/// The paint of a stop of a gradient.
Paint stopPaint(const Style& style, const Paint& current);

/// "#a" of "url(#a)", without the #; empty: no such reference.
std::string_view urlOf(std::string_view value);

// Gradients and patterns as one paint each: https://www.w3.org/TR/SVG2/pservers.html.

using Ids = std::unordered_map<std::string_view, const Node*>;

/// A gradient is as opaque as its most opaque stop, and black where all its stops are; nothing: `id` names neither.
/// \param current  currentColor. Throws Refused: too much.
std::optional<Paint> serverPaint(std::string_view id, const Ids& ids, const StyleSheet& styles, const Paint& current,
                                 Work& work);

/// The place of a fading gradient.
struct GradientPlace {
  Matrix toWorld;  ///< from user units to mm
  Bounds box;      ///< of the element it paints, in user units
  Vec2 viewport;   ///< what percentages refer to, in user units
  UserUnits units;
  Bounds around;  ///< where it matters [mm]
};

/// The area in which a gradient is seen, as far as `around` reaches: a fifth or more of its greatest opacity. Nothing
/// where that cannot be told; then all of it counts. Throws Refused: too much.
std::optional<FilledPath> seenOfGradient(const Node& gradient, const GradientPlace& place, const Ids& ids,
                                         const StyleSheet& styles, Work& work);

}  // namespace sillon::svg
