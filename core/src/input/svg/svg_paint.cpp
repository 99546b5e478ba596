#include "input/svg/svg_style.hpp"

#include <algorithm>
#include <cmath>

#include <fast_float/fast_float.h>

namespace sillon::svg {
namespace {

// Reads a number or a percentage as a share in 0..1.
std::optional<double> share(std::string_view text) {
  std::string_view rest;
  const std::optional<double> value = leadingNumber(text, rest);
  if (!value || !(rest.empty() || rest == "%")) return std::nullopt;
  return std::clamp(rest == "%" ? *value / 100 : *value, 0.0, 1.0);
}

// Parses the digits of "#rgb", "#rgba", "#rrggbb" or "#rrggbbaa".
std::optional<Paint> hexColor(std::string_view digits) {
  const bool brief = digits.size() == 3 || digits.size() == 4;
  const bool isHex = digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
  if (!isHex || !(brief || digits.size() == 6 || digits.size() == 8)) return std::nullopt;
  const std::size_t each = brief ? 1 : 2;
  Paint paint;
  const auto digit = [](char c) { return isDigit(c) ? c - '0' : c - 'a' + 10; };
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t at = brief ? k / 2 : k;
    paint.colour = 16 * paint.colour + static_cast<std::uint64_t>(digit(digits[at]));
  }
  if (digits.size() != 4 * each) return paint;
  paint.alpha = digit(digits[3 * each]) / 15.0;
  if (!brief) paint.alpha = (16 * digit(digits[6]) + digit(digits[7])) / 255.0;
  return paint;
}

// Converts HSL to RGB, https://www.w3.org/TR/css-color-4/#hsl-to-rgb. Hue is in degrees, opacity in 0..1, all else in
// 0..255.
std::array<double, 4> fromHsl(const std::array<double, 4>& hsl) {
  const double hue = hsl[0] / 360 - std::floor(hsl[0] / 360);
  const double light = std::clamp(hsl[2], 0.0, 255.0);
  const double swing = std::clamp(hsl[1] / 255, 0.0, 1.0) * std::min(light, 255 - light);
  const auto channel = [&](double from) {
    const double place = std::fmod(from + 12 * hue, 12);
    return light - swing * std::clamp(std::min(place - 3, 9 - place), -1.0, 1.0);
  };
  return {channel(0), channel(8), channel(4), hsl[3]};
}

// Reads rgb(), rgba(), hsl() or hsla(): numbers separated by commas, spaces and a slash.
Paint functionColor(std::string_view text) {
  std::array<double, 4> v{0, 0, 0, 1};
  std::size_t n = 0;
  std::string_view rest = text.substr(text.find('(') + 1);
  while (n < v.size()) {
    while (!rest.empty() && (isSpace(rest.front()) || rest.front() == ',' || rest.front() == '/'))
      rest.remove_prefix(1);
    const auto end = std::min(rest.find_first_of(" \t\r\n,/)"), rest.size());
    std::string_view unit;
    const std::optional<double> value = leadingNumber(rest.substr(0, end), unit);
    if (!value) break;
    v[n] = unit != "%" ? *value : n == 3 ? *value / 100 : *value * 255 / 100;
    rest.remove_prefix(end);
    ++n;
  }
  if (startsWith(text, "hsl")) v = fromHsl(v);
  const auto eight = [](double value) {
    return static_cast<std::uint64_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  return {std::clamp(v[3], 0.0, 1.0), eight(v[0]) << 16 | eight(v[1]) << 8 | eight(v[2])};
}

// Reads a colour; nothing if the value is none. "inherit", "unset" and "revert" yield nothing, too: like any value that
// cannot be read, they leave the inherited paint.
std::optional<Paint> colorOf(std::string_view value, const Paint& current) {
  const std::string text = lowered(trimmed(value));
  if (text == "none" || text == "transparent") return Paint{0};
  if (text == "currentcolor") return current;
  if (startsWith(text, "#"))
    return hexColor(std::string_view(text).substr(1, text.find(' ') - 1));  // "#123 icc-color()"
  const bool isFunction = text.find('(') != std::string::npos && text.find("var(") == std::string::npos;
  if (isFunction && (startsWith(text, "rgb") || startsWith(text, "hsl"))) return functionColor(text);
  if (isFunction) return Paint{1, otherColour(text)};
  const std::optional<std::uint32_t> named = namedColour(text);
  return named ? std::optional(Paint{1, *named}) : std::nullopt;
}

/// Reads `fill`, `stroke` or `color`. \param initial  the property's value where nothing declares it.
void setPaint(std::string_view value, const PaintContext& context, const Paint& current, const Paint& initial,
              Paint& paint) {
  if (value.empty()) return;
  if (lowered(value) == "initial") {
    paint = initial;
    return;
  }
  if (!startsWith(value, "url(")) {
    paint = colorOf(value, current).value_or(paint);
  } else if (const std::optional<Paint> server = context.server(urlOf(value))) {
    paint = *server;
  } else {
    const std::string_view fallback = trimmed(value.substr(std::min(value.find(')') + 1, value.size())));
    paint = fallback.empty() ? Paint{0} : colorOf(fallback, current).value_or(paint);
  }
}

void setShare(std::string_view value, double& field) {
  if (value.empty()) return;
  if (const auto read = share(value)) field = *read;
}

void setRule(const std::string& word, FillRule& rule) {
  if (word == "evenodd") rule = FillRule::EvenOdd;
  if (word == "nonzero") rule = FillRule::NonZero;
}

// Reads `stroke-dasharray`; an invalid list counts as solid.
void setDashes(std::string_view value, const PaintContext& context, LineStroke::Dashes& dashes) {
  if (value.empty() || lowered(value) == "inherit") return;
  std::vector<double> read;
  double sum = 0;
  while (!value.empty()) {
    const std::size_t end = std::min(value.find_first_of(", \t\r\n"), value.size());
    if (end > 0) {
      const double length = context.length(value.substr(0, end));
      if (!(length >= 0) || read.size() == 1000) {  // "none", or a value that cannot be read
        read.clear();
        break;
      }
      read.push_back(length);
      sum += length;
    }
    value.remove_prefix(std::min(end + 1, value.size()));
  }
  if (!(sum > 0 && std::isfinite(sum))) read.clear();
  if (read.size() % 2 == 1) {
    const std::vector<double> again = read;
    read.insert(read.end(), again.begin(), again.end());
  }
  bool gaps = false;
  for (std::size_t k = 1; k < read.size(); k += 2) gaps = gaps || read[k] > 0;
  if (!gaps) read.clear();  // without gaps, joins and caps are those of a solid line
  dashes = read.empty() ? nullptr : std::make_shared<const std::vector<double>>(std::move(read));
}

// Reads the properties of a stroke apart from its paint.
void setStroke(const Style& style, const PaintContext& context, LineStroke& stroke) {
  const double width = context.length(style.value("stroke-width"_css));
  if (width >= 0) stroke.width = width;
  const std::string cap = style.word("stroke-linecap"_css);
  if (cap == "butt") stroke.cap = StrokeCap::Butt;
  if (cap == "round") stroke.cap = StrokeCap::Round;
  if (cap == "square") stroke.cap = StrokeCap::Square;
  const std::string join = style.word("stroke-linejoin"_css);
  if (startsWith(join, "miter")) stroke.join = StrokeJoin::Miter;
  if (join == "round") stroke.join = StrokeJoin::Round;
  if (join == "bevel") stroke.join = StrokeJoin::Bevel;
  std::string_view rest;
  const auto limit = leadingNumber(style.value("stroke-miterlimit"_css), rest);
  if (limit && *limit >= 1) stroke.miterLimit = *limit;
  setDashes(style.value("stroke-dasharray"_css), context, stroke.dashes);
  const double offset = context.length(style.value("stroke-dashoffset"_css));
  if (std::isfinite(offset)) stroke.dashOffset = offset;
}

}  // namespace

std::optional<double> leadingNumber(std::string_view text, std::string_view& rest) {
  text = trimmed(text);
  if (startsWith(text, "+")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  rest = trimmed(text.substr(end - text.data()));
  return value;
}

Paint stopPaint(const Style& style, const Paint& current) {
  Paint paint = colorOf(style.value("stop-color"_css), current).value_or(Paint{});
  double opacity = 1;
  setShare(style.value("stop-opacity"_css), opacity);
  paint.alpha *= opacity;
  return paint;
}

std::string_view urlOf(std::string_view value) {
  value = trimmed(value);
  if (!startsWith(value, "url(")) return {};
  value = trimmed(value.substr(4, value.find(')') - 4));
  while (!value.empty() && (value.front() == '"' || value.front() == '\'')) value.remove_prefix(1);
  while (!value.empty() && (value.back() == '"' || value.back() == '\'')) value.remove_suffix(1);
  return startsWith(value, "#") ? value.substr(1) : std::string_view{};
}

void apply(const Style& style, const PaintContext& context, PaintState& state) {
  state.strokeScales = true;
  if (style.word("alignment-baseline"_css) != "inherit") state.letters.aligned.reset();
  if (style.empty()) return;
  if (style.setsLetters()) applyLetters(style, context, state.letters);  // first, as other lengths may be in ems
  setPaint(style.value("color"_css), context, state.color, Paint{}, state.color);
  const auto setFillOrStroke = [&](Property property, const Paint& initial, Paint& paint) {
    const std::string word = style.word(property);
    if (word == "context-fill") paint = state.outer ? state.outer->first : Paint{0};
    if (word == "context-stroke") paint = state.outer ? state.outer->second : Paint{0};
    setPaint(style.value(property), context, state.color, initial, paint);
  };
  setFillOrStroke("fill"_css, Paint{}, state.fill);
  setFillOrStroke("stroke"_css, Paint{0}, state.stroke);
  setShare(style.value("fill-opacity"_css), state.fillOpacity);
  setShare(style.value("stroke-opacity"_css), state.strokeOpacity);
  double opacity = 1;
  setShare(style.value("opacity"_css), opacity);
  state.opacity *= opacity;
  const std::string visibility = style.word("visibility"_css);
  if (visibility == "visible") state.visible = true;
  if (visibility == "hidden" || visibility == "collapse") state.visible = false;
  state.strokeScales = style.word("vector-effect"_css) != "non-scaling-stroke";
  setRule(style.word("fill-rule"_css), state.fillRule);
  setRule(style.word("clip-rule"_css), state.clipRule);
  setStroke(style, context, state.line);
}

}  // namespace sillon::svg
