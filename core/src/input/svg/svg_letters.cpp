#include "input/svg/svg_letters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sillon::svg {
namespace {

constexpr std::size_t kNoStyle = static_cast<std::size_t>(-1);
const std::string kSquare = "M0 0H1V1H0Z";
constexpr double kLineWidth = 0.1;  // of lines under, through and above letters, as browsers draw them [em]

/// Calls body(index, value) for the numbers of an attribute, in user units.
template <class Body>
void forLengths(const Node& node, const char* name, double full, const UserUnits& units, const Body& body) {
  std::size_t index = 0;
  std::string_view rest = attribute(node, name).value_or("");
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(", \t\r\n"), rest.size());
    if (end > 0) {
      const double length = units.ofStyle(rest.substr(0, end), full);
      if (!std::isfinite(length)) {
        refuse(std::string(name) + " is " + quoted(*attribute(node, name)) + "; it must be lengths");
      }
      body(index++, length);
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

std::size_t bytesOfLetter(std::string_view text) {
  std::size_t bytes = 1;
  while (bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) ++bytes;
  return bytes;
}

/// Tells whether a text ends with a space; the second is the one that keeps words together.
bool endsWord(std::string_view text) { return text.ends_with(' ') || text.ends_with("\xC2\xA0"); }

/// In capitals or small letters, where that takes a difference of codes: in ASCII, Latin-1 and Cyrillic.
/// \return nothing for other letters.
std::optional<std::string> recased(std::string_view letter, LetterCase into) {
  if (into == LetterCase::AsWritten) return std::string(letter);
  const bool up = into == LetterCase::Upper;
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(letter[k]); };
  if (letter.size() == 1) {
    const char c = letter[0];
    return std::string(1, up && c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : up ? c : lower(c));
  }
  if (letter.size() > 2) return byte(0) == 0xE2 ? std::optional(std::string(letter)) : std::nullopt;  // punctuation
  const int code = (byte(0) & 0x1F) << 6 | (byte(1) & 0x3F);
  int other = code;
  const auto pair = [&](int first, int last, int step) {  // small letters `step` above their capitals
    if (up && code >= first + step && code <= last + step) other = code - step;
    if (!up && code >= first && code <= last) other = code + step;
  };
  const bool known = (code < 0x100 && code != 0xDF && code != 0xFF && code != 0xB5) || (code >= 0x400 && code < 0x460);
  if (!known) return std::nullopt;
  if (code != 0xD7 && code != 0xF7) pair(0xC0, 0xDE, 0x20);
  pair(0x410, 0x42F, 0x20);
  pair(0x400, 0x40F, 0x50);
  return std::string{static_cast<char>(0xC0 | other >> 6), static_cast<char>(0x80 | (other & 0x3F))};
}

/// Sizes in words, for a usual size of 16 px.
constexpr std::array<std::pair<std::string_view, const char*>, 8> kSizes{{{"xx-small", "9px"},
                                                                          {"x-small", "10px"},
                                                                          {"small", "13px"},
                                                                          {"medium", "16px"},
                                                                          {"large", "18px"},
                                                                          {"x-large", "24px"},
                                                                          {"xx-large", "32px"},
                                                                          {"xxx-large", "48px"}}};

/// \param inherited  what shares refer to. \return nothing for what is no size.
std::optional<double> sizeOf(std::string_view value, const PaintContext& context, double inherited) {
  const std::string word = lowered(trimmed(value));
  for (const auto& [name, size] : kSizes) {
    if (word == name) return context.length(size);
  }
  if (word == "larger") return 1.2 * inherited;
  if (word == "smaller") return inherited / 1.2;
  std::string_view unit;
  const std::optional<double> number = leadingNumber(word, unit);
  if (!number || *number < 0) return std::nullopt;
  const double share = unit == "em" ? 1 : unit == "ex" ? 0.5 : unit == "%" ? 0.01 : 0;
  const double length = share > 0 ? *number * share * inherited : context.length(word);
  return std::isfinite(length) ? std::optional(length) : std::nullopt;
}

/// Tells whether a word is a property's initial value.
bool isPlain(const std::string& word) {
  constexpr std::array<std::string_view, 13> kPlain{"normal", "none", "auto", "initial", "unset",
                                                    "revert", "ltr",  "lr",   "lr-tb",   "horizontal-tb",
                                                    "solid",  "100%", "400"};
  return std::find(kPlain.begin(), kPlain.end(), word) != kPlain.end();
}

void setUnread(Property property, const std::string& word, std::uint32_t& unread) {
  if (word.empty() || word == "inherit") return;
  const auto found = std::find(kUnreadOfLetters.begin(), kUnreadOfLetters.end(), property);
  const std::uint32_t bit = std::uint32_t{1} << (found - kUnreadOfLetters.begin());
  unread = isPlain(word) ? unread & ~bit : unread | bit;
}

/// `font: italic bold 12px/1.4 Arial, sans-serif`. \return the families.
std::string_view setFont(std::string_view value, const PaintContext& context, LetterStyle& letters) {
  std::uint32_t unread = letters.unread;
  for (const Property property : {Property::FontStyle, Property::FontVariant, Property::FontWeight}) {
    setUnread(property, "normal", unread);
  }
  while (!(value = trimmed(value)).empty()) {
    const std::size_t end = std::min(value.find_first_of(" \t\r\n"), value.size());
    const std::string token = lowered(value.substr(0, end));
    value.remove_prefix(end);
    // Weights are numbers, too, but without a unit.
    const bool number = token.find_first_not_of("0123456789") == std::string::npos;
    const std::optional<double> size =
        number ? std::nullopt : sizeOf(token.substr(0, token.find('/')), context, letters.size);
    if (size) {
      letters.size = *size;
      letters.unread = unread;
      return trimmed(value);
    }
    const bool slanted = token == "italic" || token == "oblique";
    setUnread(slanted                 ? Property::FontStyle
              : token == "small-caps" ? Property::FontVariant
                                      : Property::FontWeight,
              token, unread);
  }
  return {};
}

std::optional<BaseLine> baseLineOf(const std::string& word) {
  if (word == "alphabetic") return BaseLine::Alphabetic;
  if (word == "middle") return BaseLine::Middle;
  if (word == "central") return BaseLine::Central;
  if (word == "hanging") return BaseLine::Hanging;
  if (word == "mathematical") return BaseLine::Mathematical;
  if (word == "text-before-edge" || word == "before-edge") return BaseLine::Above;
  if (word == "ideographic" || word == "text-after-edge" || word == "after-edge") return BaseLine::Below;
  return std::nullopt;
}

/// Height of a base line above the one on which letters stand, in font units.
double heightOf(BaseLine line, const ShapedLine& font) {
  switch (line) {
    case BaseLine::Middle:
      return font.xHeight / 2;
    case BaseLine::Central:
      return (font.ascent - font.descent) / 2;
    case BaseLine::Hanging:
      return 0.8 * font.ascent;
    case BaseLine::Mathematical:
      return 0.5 * font.ascent;
    case BaseLine::Above:
      return font.ascent;
    case BaseLine::Below:
      return -font.descent;
    case BaseLine::Alphabetic:
      break;
  }
  return 0;
}

void setDecoration(const Style& style, LetterStyle& letters) {
  for (const Property property : {Property::TextDecoration, Property::TextDecorationLine}) {
    const std::string value = style.word(property);
    std::string_view rest = value;
    while (!(rest = trimmed(rest)).empty()) {
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n"));
      rest.remove_prefix(word.size());
      letters.underlined = letters.underlined || word == "underline";
      letters.overlined = letters.overlined || word == "overline";
      letters.struckThrough = letters.struckThrough || word == "line-through";
      for (const char* line : {"wavy", "dotted", "dashed", "double"}) {
        if (word == line) setUnread(Property::TextDecorationStyle, line, letters.unread);
      }
    }
  }
}

/// A run as it lies without regard to anchors.
struct LaidRun {
  const LetterShaper::Line* line = nullptr;  ///< null: it shows nothing
  double scale = 0;                          ///< from font units to user units
  Vec2 at;                                   ///< of its pen
  double width = 0;
};

/// Shifts the runs that belong together, so that they begin, end or have their middle at their place.
void anchor(LaidRun* first, const LaidRun* end, double share) {
  double left = first->at.x, right = first->at.x;
  for (const LaidRun* run = first; run != end; ++run) {
    left = std::min({left, run->at.x, run->at.x + run->width});
    right = std::max({right, run->at.x, run->at.x + run->width});
  }
  const double shift = first->at.x - (left + share * (right - left));
  for (LaidRun* run = first; run != end; ++run) run->at.x += shift;
}

/// Adds the letters of a run, and the lines along it.
void place(const LaidRun& run, const LetterRun& of, const LetterStyle& style, std::vector<PlacedLetter>& placed) {
  const ShapedLine& line = run.line->line;
  const double scale = run.scale;
  const double y = run.at.y - style.raise - style.raiseInHeights * (line.ascent + line.descent) / line.em +
                   heightOf(style.aligned.value_or(style.baseLine), line) * scale;
  const Matrix turned = shifted(run.at.x, y) * rotation(of.turn) * shifted(-run.at.x, -y);
  const auto add = [&](const std::string& outline, const Matrix& at) {
    placed.push_back({&outline, of.turn == 0 ? at : turned * at, of.style});
  };
  const double thick = kLineWidth * style.size;
  const auto addLine = [&](double top) { add(kSquare, matrix(run.width, 0, 0, thick, run.at.x, y + top)); };
  if (style.underlined) addLine(thick / 2);
  if (style.overlined) addLine(-line.ascent * scale - thick);
  double pen = run.at.x;
  for (std::size_t k = 0; k < line.letters.size(); ++k) {
    const ShapedLine::Letter& letter = line.letters[k];
    add(*run.line->outlines[k],
        matrix(scale, 0, 0, -scale, pen + letter.offset.x * scale, y - letter.offset.y * scale));
    if (letter.advance != 0) pen += letter.advance * scale + style.spacing;
  }
  if (style.struckThrough) addLine(-line.ascent * scale / 3 - thick / 2);
}

}  // namespace

void applyLetters(const Style& style, const PaintContext& context, LetterStyle& letters) {
  const std::string_view inFont = setFont(style.value(Property::Font), context, letters);
  if (const auto size = sizeOf(style.value(Property::FontSize), context, letters.size)) letters.size = *size;
  const std::string_view families = style.value(Property::FontFamily);
  if (!families.empty() && lowered(families.substr(0, 8)) != "inherit") {
    letters.font = context.font(families);
  } else if (!inFont.empty()) {
    letters.font = context.font(inFont);
  }
  const std::string anchor = style.word(Property::TextAnchor);
  if (anchor == "start") letters.anchor = 0;
  if (anchor == "middle") letters.anchor = 0.5;
  if (anchor == "end") letters.anchor = 1;
  const auto setSpacing = [&](Property property, double& spacing) {
    if (style.word(property) == "normal") spacing = 0;
    if (const double length = context.length(style.value(property)); std::isfinite(length)) spacing = length;
  };
  setSpacing(Property::LetterSpacing, letters.spacing);
  setSpacing(Property::WordSpacing, letters.wordSpacing);
  if (const auto line = baseLineOf(style.word(Property::DominantBaseline))) letters.baseLine = *line;
  letters.aligned = baseLineOf(style.word(Property::AlignmentBaseline));
  const std::string space = style.word(Property::WhiteSpace);
  if (!space.empty() && space != "inherit") {
    letters.keepsSpaces = space == "pre" || space == "pre-wrap" || space == "break-spaces";
  }
  const std::string transform = style.word(Property::TextTransform);
  if (transform == "none" || transform == "capitalize") letters.letterCase = LetterCase::AsWritten;
  if (transform == "uppercase") letters.letterCase = LetterCase::Upper;
  if (transform == "lowercase") letters.letterCase = LetterCase::Lower;
  setDecoration(style, letters);
  for (const Property property : kUnreadOfLetters) {
    const bool isCase = property == Property::TextTransform && letters.letterCase != LetterCase::AsWritten;
    setUnread(property, isCase ? "none" : style.word(property), letters.unread);
  }
}

void raiseLetters(const Style& style, const PaintContext& context, LetterStyle& letters) {
  const std::string& value = style.value(Property::BaselineShift);
  const std::string word = lowered(value);
  std::string_view unit;
  const std::optional<double> number = leadingNumber(word, unit);
  if (word == "sub") letters.raiseInHeights -= letters.size / 2;
  if (word == "super") letters.raiseInHeights += letters.size / 2;
  const double length = number && unit == "%" ? *number / 100 * letters.size : context.length(value);
  if (std::isfinite(length)) letters.raise += length;
}

std::vector<std::string_view> unreadOf(const LetterStyle& letters) {
  std::vector<std::string_view> names;
  for (std::size_t k = 0; k < kUnreadOfLetters.size(); ++k) {
    if ((letters.unread >> k & 1) != 0) names.push_back(nameOf(kUnreadOfLetters[k]));
  }
  return names;
}

void LetterRuns::open(const Node& node, const UserUnits& units) {
  inside_.push_back(elements_.size());
  elements_.push_back({&node, units, letters_.size(), letters_.size(), kNoStyle});
}

void LetterRuns::close() {
  Element& element = elements_[inside_.back()];
  element.end = letters_.size();
  if (inside_.back() + 1 == elements_.size() && element.begin == element.end) elements_.pop_back();
  inside_.pop_back();
}

void LetterRuns::add(std::string_view text, const PaintState& paint) {
  Element& element = elements_[inside_.back()];
  const LetterStyle& style = paint.letters;
  while (!text.empty()) {
    const std::string_view letter = text.substr(0, bytesOfLetter(text));
    text.remove_prefix(letter.size());
    const bool space = letter.size() == 1 && isSpace(letter[0]);
    if (space && afterSpace_ && !style.keepsSpaces) continue;
    afterSpace_ = space && !style.keepsSpaces;
    lettersLeft_ -= std::ssize(letter);
    if (lettersLeft_ < 0) refuseTooLarge("the drawing has more than " + std::to_string(kMaxLetters) + " letters");
    if (element.style == kNoStyle) {
      element.style = styles_.size();
      styles_.push_back(paint);
    }
    letters_.push_back({text_.size(), element.style, {}, {}, {}, 0});
    const std::optional<std::string> shown = recased(letter, style.letterCase);
    if (!shown) setUnread(Property::TextTransform, "capitals", styles_[element.style].letters.unread);
    text_ += space ? " " : shown ? *shown : std::string(letter);
  }
}

void LetterRuns::place(const Element& element, Vec2 viewport) {
  if (elementName(*element.node) == "a") return;
  const auto count = std::min(element.end, letters_.size()) - std::min(element.begin, letters_.size());
  Letter* const own = letters_.data() + element.begin;
  const auto forOwn = [&](const char* name, double full, const auto& body) {
    forLengths(*element.node, name, full, element.units, [&](std::size_t k, double length) {
      if (k < count) body(own[k], length);
    });
  };
  forOwn("x", viewport.x, [](Letter& letter, double length) { letter.x = length; });
  forOwn("y", viewport.y, [](Letter& letter, double length) { letter.y = length; });
  forOwn("dx", viewport.x, [](Letter& letter, double length) { letter.shift.x = length; });
  forOwn("dy", viewport.y, [](Letter& letter, double length) { letter.shift.y = length; });
  std::size_t turned = 0;
  forOwn("rotate", 1, [&](Letter& letter, double degrees) {
    letter.turn = degrees;
    turned = static_cast<std::size_t>(&letter - own) + 1;
  });
  for (; turned > 0 && turned < count; ++turned) own[turned].turn = own[turned - 1].turn;  // the last one goes on
}

std::vector<LetterRun> LetterRuns::take(Vec2 viewport) {
  if (!letters_.empty() && afterSpace_) {
    text_.resize(letters_.back().begin);
    letters_.pop_back();
  }
  for (const Element& element : elements_) place(element, viewport);
  std::vector<LetterRun> runs;
  for (std::size_t k = 0; k < letters_.size(); ++k) {
    const Letter& letter = letters_[k];
    const std::size_t end = k + 1 < letters_.size() ? letters_[k + 1].begin : text_.size();
    const std::string_view text = std::string_view(text_).substr(letter.begin, end - letter.begin);
    const bool placed = letter.x || letter.y || letter.shift != Vec2{} || letter.turn != 0;
    // Words that stand apart are runs, too, and so are letters of spaced ligatures. Others may join: they stay
    // together.
    const LetterStyle& style = styles_[letter.style].letters;
    const auto before = std::string_view(text_).substr(0, letter.begin);
    const bool apart = (style.wordSpacing != 0 && endsWord(before)) ||
                       (style.spacing != 0 && before.ends_with('f') && std::string_view("fijlt").find(text[0]) < 5);
    if (runs.empty() || placed || apart || letter.style != runs.back().style || runs.back().turn != 0) {
      runs.push_back({{}, letter.style, letter.x, letter.y, letter.shift, letter.turn});
    }
    runs.back().text += text;
  }
  return runs;
}

Result<const LetterShaper::Line*> LetterShaper::of(const DrawingFont& font, const std::string& text) {
  const auto [place, fresh] = lines_.try_emplace(font.name + '\n' + text);
  if (!fresh) return &place->second;
  Result<ShapedLine> shaped = shape_.shape(font, text);
  if (!shaped) {
    lines_.erase(place);
    return shaped.error();
  }
  Line& line = place->second;
  line.line = std::move(shaped).value();
  std::vector<const std::string*> kept;
  for (std::string& outline : line.line.outlines) kept.push_back(&*outlines_.insert(std::move(outline)).first);
  line.line.outlines = {};
  tookOtherFont_ = tookOtherFont_ || line.line.instead;
  for (const ShapedLine::Letter& letter : line.line.letters) line.outlines.push_back(kept[letter.outline]);
  return &line;
}

Result<std::vector<PlacedLetter>> placeLetters(const std::vector<LetterRun>& runs,
                                               const std::vector<PaintState>& styles, LetterShaper& shaper) {
  std::vector<LaidRun> laid(runs.size());
  Vec2 pen;
  std::size_t first = 0;
  const auto anchorFrom = [&](std::size_t end) {
    if (first < end) anchor(&laid[first], laid.data() + end, styles[runs[first].style].letters.anchor);
    first = end;
  };
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const LetterRun& run = runs[k];
    const LetterStyle& style = styles[run.style].letters;
    if (run.x || run.y) anchorFrom(k);
    pen = Vec2{run.x.value_or(pen.x), run.y.value_or(pen.y)} + run.shift;
    laid[k].at = pen;
    if (style.size > 0) {
      const Result<const LetterShaper::Line*> line = shaper.of(style.font, run.text);
      if (!line) return line.error();
      laid[k].line = line.value();
      laid[k].scale = style.size / line.value()->line.em;
      for (const ShapedLine::Letter& letter : line.value()->line.letters) {
        if (letter.advance != 0) laid[k].width += letter.advance * laid[k].scale + style.spacing;
      }
    }
    if (style.wordSpacing != 0 && endsWord(run.text)) {
      laid[k].width += style.wordSpacing;
    }
    pen.x += laid[k].width;
  }
  anchorFrom(runs.size());

  std::vector<PlacedLetter> placed;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (laid[k].line != nullptr) place(laid[k], runs[k], styles[runs[k].style].letters, placed);
  }
  return placed;
}

}  // namespace sillon::svg
