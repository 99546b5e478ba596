#include "input/svg/svg_letters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "input/shaped_line.hpp"

namespace sillon::svg {
namespace {

constexpr std::size_t kNoStyle = -1;
const std::string kSquare = "M0 0H1V1H0Z";
constexpr double kLineWidth = 0.1;  // thickness of lines under, through and above letters in browsers [em]
constexpr double kSlant = 0.25;     // slant that browsers give to italic letters of an upright font

/// Reads the list of lengths of an attribute, in user units.
std::vector<double> lengthsOf(const Node& node, const char* name, double full, const UserUnits& units) {
  std::vector<double> lengths;
  std::string_view rest = attribute(node, name).value_or("");
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(", \t\r\n"), rest.size());
    if (end > 0) {
      lengths.push_back(units.ofStyle(rest.substr(0, end), full));
      if (!std::isfinite(lengths.back())) {
        refuse("SvgLengths", {{"attribute", name}, {"text", quoted(*attribute(node, name))}});
      }
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return lengths;
}

std::size_t bytesOfLetter(std::string_view text) {
  std::size_t bytes = 1;
  while (bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) ++bytes;
  return bytes;
}

/// Tells whether a text ends with a space or a no-break space.
bool endsWord(std::string_view text) { return text.ends_with(' ') || text.ends_with("\xC2\xA0"); }

/// Converts a letter to capitals or small letters if they differ by a constant code offset: in ASCII, Latin-1 and
/// Cyrillic.
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
  const auto pair = [&](int first, int last, int step) {  // small letters have codes `step` above their capitals
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

/// CSS sizes in words, for a default size of 16 px.
constexpr std::array<std::pair<std::string_view, const char*>, 8> kSizes{{{"xx-small", "9px"},
                                                                          {"x-small", "10px"},
                                                                          {"small", "13px"},
                                                                          {"medium", "16px"},
                                                                          {"large", "18px"},
                                                                          {"x-large", "24px"},
                                                                          {"xx-large", "32px"},
                                                                          {"xxx-large", "48px"}}};

/// Reads a font size.
/// \param inherited  size that shares such as "em" and "%" refer to.
/// \return nothing if the value is no size.
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
  // Heavy weights count, too, because most built-in fonts are bold.
  constexpr std::array<std::string_view, 19> kPlain{
      "normal", "none", "auto", "initial", "unset",  "revert", "ltr", "lr",  "lr-tb", "horizontal-tb",
      "solid",  "100%", "400",  "bold",    "bolder", "600",    "700", "800", "900"};
  return std::find(kPlain.begin(), kPlain.end(), word) != kPlain.end();
}

void setUnread(Property property, const std::string& word, std::uint32_t& unread) {
  if (word.empty() || word == "inherit") return;
  const auto found = std::find(kUnreadOfLetters.begin(), kUnreadOfLetters.end(), property);
  const std::uint32_t bit = std::uint32_t{1} << (found - kUnreadOfLetters.begin());
  unread = isPlain(word) ? unread & ~bit : unread | bit;
}

/// Reads the shorthand `font: italic bold 12px/1.4 Arial, sans-serif`. \return the families.
std::string_view setFont(std::string_view value, const PaintContext& context, LetterStyle& letters) {
  std::uint32_t unread = letters.unread;
  for (const Property property : {"font-variant"_css, "font-weight"_css}) setUnread(property, "normal", unread);
  bool slanted = false;
  while (!(value = trimmed(value)).empty()) {
    const std::size_t end = std::min(value.find_first_of(" \t\r\n"), value.size());
    const std::string token = lowered(value.substr(0, end));
    value.remove_prefix(end);
    // Weights are numbers like sizes, but they have no unit.
    const bool number = token.find_first_not_of("0123456789") == std::string::npos;
    const std::optional<double> size =
        number ? std::nullopt : sizeOf(token.substr(0, token.find('/')), context, letters.size);
    if (size) {
      letters.size = *size;
      letters.unread = unread;
      letters.slanted = slanted;
      return trimmed(value);
    }
    const bool slants = token == "italic" || token == "oblique";
    slanted = slanted || slants;
    if (!slants) setUnread(token == "small-caps" ? "font-variant"_css : "font-weight"_css, token, unread);
  }
  return {};
}

/// Parses a base line; nothing for words that are not supported.
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

/// Returns the height of a base line above the alphabetic one, in font units.
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

/// Reads the lines under, above and through letters.
void setDecoration(const Style& style, LetterStyle& letters) {
  for (const Property property : {"text-decoration"_css, "text-decoration-line"_css}) {
    const std::string value = style.word(property);
    std::string_view rest = value;
    while (!(rest = trimmed(rest)).empty()) {
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n"));
      rest.remove_prefix(word.size());
      letters.underlined = letters.underlined || word == "underline";
      letters.overlined = letters.overlined || word == "overline";
      letters.struckThrough = letters.struckThrough || word == "line-through";
      for (const char* line : {"wavy", "dotted", "dashed", "double"}) {
        if (word == line) setUnread("text-decoration-style"_css, line, letters.unread);
      }
    }
  }
}

/// A run as it lies before anchors are applied.
struct LaidRun {
  const LetterShaper::Line* line = nullptr;  ///< null if the run shows nothing
  double scale = 0;                          ///< from font units to user units
  double wide = 1;                           ///< further horizontal scale, from textLength
  double spacing = 0;                        ///< space added after each letter
  Vec2 at;                                   ///< position of the pen
  double width = 0;

  [[nodiscard]] double advance(const ShapedLine::Letter& letter) const {
    return letter.advance == 0 ? 0 : letter.advance * scale * wide + spacing;
  }
};

/// Shifts runs that belong together, so that they begin, end or have their middle at their place.
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
  // Returns the frame in which a part of the run begins: the whole run, or a single letter if letters stand on a path.
  const auto frameAt = [&](double pen, double width) -> std::optional<Matrix> {
    std::optional<Matrix> frame = shifted(pen, y);
    if (of.path) frame = of.path->at(pen + width / 2);
    if (frame) frame = *frame * rotation(of.turn);
    if (frame && of.path) frame = *frame * shifted(-width / 2, y);
    return frame;
  };
  const auto add = [&](const std::string& outline, const std::optional<Matrix>& frame, const Matrix& at) {
    if (frame) placed.push_back({&outline, *frame * at, of.style});
  };
  const double thick = kLineWidth * style.size;
  const auto addLine = [&](double top) {
    if (!of.path) return add(kSquare, frameAt(run.at.x, run.width), matrix(run.width, 0, 0, thick, 0, top));
    double pen = run.at.x;
    for (const ShapedLine::Letter& letter : line.letters) {
      const double width = run.advance(letter);
      if (width > 0) add(kSquare, frameAt(pen, width), matrix(width, 0, 0, thick, 0, top));
      pen += width;
    }
  };
  if (style.underlined) addLine(thick / 2);
  if (style.overlined) addLine(-line.ascent * scale - thick);
  const std::optional<Matrix> whole = frameAt(run.at.x, run.width);
  const double slant = style.slanted ? kSlant * scale : 0;
  double pen = 0;
  for (std::size_t k = 0; k < line.letters.size(); ++k) {
    const ShapedLine::Letter& letter = line.letters[k];
    const double advance = run.advance(letter);
    const double from = of.path ? 0 : pen;
    add(*run.line->outlines[k], of.path ? frameAt(run.at.x + pen, advance) : whole,
        matrix(scale * run.wide, 0, slant, -scale, from + letter.offset.x * scale * run.wide,
               -letter.offset.y * scale));
    pen += advance;
  }
  if (style.struckThrough) addLine(-line.ascent * scale / 3 - thick / 2);
}

/// Adds the kerning between adjacent runs of one element: letters that are moved one by one form runs of their own.
std::optional<Error> kern(const std::vector<LetterRun>& runs, const std::deque<PaintState>& styles,
                          LetterShaper& shaper, std::vector<LaidRun>& laid) {
  for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
    const LetterStyle& style = styles[runs[k].style].letters;
    const LetterRun& next = runs[k + 1];
    if (next.x || next.y || laid[k].line == nullptr || next.style != runs[k].style) continue;
    std::size_t begin = runs[k].text.size() - 1;
    while (begin > 0 && (static_cast<unsigned char>(runs[k].text[begin]) & 0xC0) == 0x80) --begin;
    const std::string_view one = std::string_view(runs[k].text).substr(begin);
    const std::string_view other = std::string_view(next.text).substr(0, bytesOfLetter(next.text));
    // The kerning is the width of both letters together, less the width of each.
    double width = 0;
    std::string text = std::string(one) + std::string(other);
    for (const int part : {0, 1, 2}) {
      if (part > 0) text = part == 1 ? one : other;
      const Result<const LetterShaper::Line*> line = shaper.of(style.font, text);
      if (!line) return line.error();
      for (const ShapedLine::Letter& letter : line.value()->line.letters) width += (part > 0 ? -1 : 1) * letter.advance;
    }
    laid[k].width += width * laid[k].scale;
  }
  return std::nullopt;
}

/// Applies `textLength`: sets letters apart, or makes them wider.
void stretch(const std::vector<LetterRun>& runs, std::vector<LaidRun>& laid) {
  for (std::size_t first = 0, end = 0; first < runs.size(); first = end) {
    const TextLength* const wanted = runs[first].stretch.get();
    double width = 0, letters = 0;
    for (end = first; end < runs.size() && runs[end].stretch.get() == wanted; ++end) {
      width += laid[end].width + (end > first ? runs[end].shift.x : 0);
      if (laid[end].line == nullptr) continue;
      for (const ShapedLine::Letter& letter : laid[end].line->line.letters) letters += letter.advance == 0 ? 0 : 1;
    }
    if (!wanted || !(width > 0) || (letters < 2 && !wanted->glyphs)) continue;
    const double apart = wanted->glyphs ? 0 : (wanted->length - width) / (letters - 1);
    for (std::size_t k = first; k < end; ++k) {
      LaidRun& run = laid[k];
      if (wanted->glyphs) {
        run.wide = wanted->length / width;
        run.spacing *= run.wide;
        run.width *= run.wide;
      } else if (run.line != nullptr) {
        run.spacing += apart;
        for (const ShapedLine::Letter& letter : run.line->line.letters) run.width += letter.advance == 0 ? 0 : apart;
      }
    }
    laid[end - 1].width -= apart;
  }
}

}  // namespace

void applyLetters(const Style& style, const PaintContext& context, LetterStyle& letters) {
  const std::string_view inFont = setFont(style.value("font"_css), context, letters);
  if (const auto size = sizeOf(style.value("font-size"_css), context, letters.size)) letters.size = *size;
  const std::string_view families = style.value("font-family"_css);
  if (!families.empty() && lowered(families.substr(0, 8)) != "inherit") {
    letters.font = context.font(families);
  } else if (!inFont.empty()) {
    letters.font = context.font(inFont);
  }
  const std::string slant = style.word("font-style"_css);
  if (slant == "normal") letters.slanted = false;
  if (startsWith(slant, "italic") || startsWith(slant, "oblique")) letters.slanted = true;
  const std::string anchor = style.word("text-anchor"_css);
  if (anchor == "start") letters.anchor = 0;
  if (anchor == "middle") letters.anchor = 0.5;
  if (anchor == "end") letters.anchor = 1;
  const auto setSpacing = [&](Property property, double& spacing) {
    if (style.word(property) == "normal") spacing = 0;
    const std::string& value = style.value(property);
    std::string_view unit;
    const std::optional<double> number = leadingNumber(value, unit);
    const double length = number && unit == "%" ? *number / 100 * letters.size : context.length(value);
    if (std::isfinite(length)) spacing = length;
  };
  setSpacing("letter-spacing"_css, letters.spacing);
  setSpacing("word-spacing"_css, letters.wordSpacing);
  if (const auto line = baseLineOf(style.word("dominant-baseline"_css))) letters.baseLine = *line;
  const std::string aligned = style.word("alignment-baseline"_css);
  if (aligned != "inherit") letters.aligned = baseLineOf(aligned);
  const std::string space = style.word("white-space"_css);
  if (!space.empty() && space != "inherit") {
    letters.keepsSpaces = space == "pre" || space == "pre-wrap" || space == "break-spaces";
  }
  const std::string transform = style.word("text-transform"_css);
  if (transform == "none" || transform == "capitalize") letters.letterCase = LetterCase::AsWritten;
  if (transform == "uppercase") letters.letterCase = LetterCase::Upper;
  if (transform == "lowercase") letters.letterCase = LetterCase::Lower;
  setDecoration(style, letters);
  for (const Property property : kUnreadOfLetters) {
    const bool isCase = property == "text-transform"_css && letters.letterCase != LetterCase::AsWritten;
    setUnread(property, isCase ? "none" : style.word(property), letters.unread);
  }
}

void raiseLetters(const Style& style, const PaintContext& context, LetterStyle& letters) {
  const std::string& value = style.value("baseline-shift"_css);
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

void TextPath::add(Vec2 from, Vec2 to) {
  const double size = std::sqrt(dot(to - from, to - from));
  if (!(size > 0)) return;
  legs_.push_back({length_, from, (to - from) * (1 / size)});
  length_ += size;
}

std::optional<Matrix> TextPath::at(double distance) const {
  if (legs_.empty() || distance < 0 || distance > length_) return std::nullopt;
  const auto next =
      std::upper_bound(legs_.begin(), legs_.end(), distance, [](double at, const Leg& leg) { return at < leg.begin; });
  const Leg& leg = *(next - 1);
  const Vec2 p = leg.from + leg.along * (distance - leg.begin);
  return matrix(leg.along.x, leg.along.y, -leg.along.y, leg.along.x, p.x, p.y);
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
    if (lettersLeft_ < 0) refuseTooLarge("SvgLetters", {{"most", kMaxLetters}});
    if (element.style == kNoStyle) {
      element.style = styles_.size();
      styles_.push_back(paint);
    }
    letters_.push_back({text_.size(), element.style, {}, {}, {}, 0, path_, stretch_});
    const std::optional<std::string> shown = recased(letter, style.letterCase);
    if (!shown) setUnread("text-transform"_css, "capitals", styles_[element.style].letters.unread);
    text_ += space ? " " : shown ? *shown : std::string(letter);
  }
}

void LetterRuns::place(const Element& element, Vec2 viewport) {
  if (elementName(*element.node) == "a") return;
  const bool onPath = elementName(*element.node) == "textPath";
  const auto count = onPath ? 0 : std::min(element.end, letters_.size()) - std::min(element.begin, letters_.size());
  const auto own = letters_.begin() + static_cast<std::ptrdiff_t>(element.begin);
  for (const char* const name : {"x", "y", "dx", "dy", "rotate"}) {
    const bool across = std::string_view(name).ends_with('x'), turns = name[0] == 'r';
    const std::string_view text = attribute(*element.node, name).value_or("");
    if (turns && text.find_first_not_of("0123456789+-.eE, \t\r\n") != std::string_view::npos) continue;
    const std::vector<double> list = lengthsOf(*element.node, name, across ? viewport.x : viewport.y, element.units);
    for (std::size_t k = 0; k < count && !list.empty(); ++k) {
      if (turns) {
        own[k].turn = list[std::min(k, list.size() - 1)];  // the last angle applies to all further letters
      } else if (k < list.size() && name[0] == 'd') {
        (across ? own[k].shift.x : own[k].shift.y) = list[k];
      } else if (k < list.size()) {
        (across ? own[k].x : own[k].y) = list[k];
      }
    }
  }
}

std::vector<LetterRun> LetterRuns::take(Vec2 viewport) {
  if (!letters_.empty() && afterSpace_) {
    text_.resize(letters_.back().begin);
    letters_.pop_back();
  }
  for (const Element& element : elements_) place(element, viewport);
  std::vector<LetterRun> runs;
  runs.reserve(std::min(letters_.size(), styles_.size() * 2));  // most elements have one run
  for (std::size_t k = 0; k < letters_.size(); ++k) {
    const Letter& letter = letters_[k];
    const std::size_t end = k + 1 < letters_.size() ? letters_[k + 1].begin : text_.size();
    const std::string_view text = std::string_view(text_).substr(letter.begin, end - letter.begin);
    const bool placed = letter.x || letter.y || letter.shift != Vec2{} || letter.turn != 0;
    // A new run begins at spaced words, and at letters that would form a ligature despite letter spacing. All other
    // letters stay in one run, because they may join.
    const LetterStyle& style = styles_[letter.style].letters;
    const auto before = std::string_view(text_).substr(0, letter.begin);
    const bool apart = (style.wordSpacing != 0 && endsWord(before)) ||
                       (style.spacing != 0 && before.ends_with('f') && std::string_view("fijlt").find(text[0]) < 5);
    const bool goesOn = !runs.empty() && letter.style == runs.back().style && letter.path == runs.back().path &&
                        letter.stretch == runs.back().stretch && runs.back().turn == 0;
    if (!goesOn || placed || apart) {
      runs.push_back({{}, letter.style, letter.x, letter.y, letter.shift, letter.turn, letter.path, letter.stretch});
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

Result<std::vector<PlacedLetter>> placeLetters(const std::vector<LetterRun>& runs, const std::deque<PaintState>& styles,
                                               LetterShaper& shaper) {
  std::vector<LaidRun> laid(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const LetterStyle& style = styles[runs[k].style].letters;
    if (style.size > 0) {
      const Result<const LetterShaper::Line*> line = shaper.of(style.font, runs[k].text);
      if (!line) return line.error();
      laid[k].line = line.value();
      laid[k].scale = style.size / line.value()->line.em;
      laid[k].spacing = style.spacing;
      for (const ShapedLine::Letter& letter : line.value()->line.letters) laid[k].width += laid[k].advance(letter);
    }
    if (style.wordSpacing != 0 && endsWord(runs[k].text)) laid[k].width += style.wordSpacing;
  }
  if (const std::optional<Error> error = kern(runs, styles, shaper, laid)) return *error;
  stretch(runs, laid);

  Vec2 pen;
  std::size_t first = 0;
  const auto anchorFrom = [&](std::size_t end) {
    if (first < end) anchor(&laid[first], laid.data() + end, styles[runs[first].style].letters.anchor);
    first = end;
  };
  const TextPath* path = nullptr;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const LetterRun& run = runs[k];
    const bool begins = run.path.get() != path;
    if (run.x || run.y || begins) anchorFrom(k);
    if (begins && run.path) pen = {run.path->start, 0};
    if (begins && !run.path) {  // after a path, the pen stands at the path's end
      const Eigen::Vector2d end = path->at(path->length()).value_or(Matrix::Identity()).translation();
      pen = {end.x(), end.y()};
    }
    path = run.path.get();
    if (path != nullptr) {
      pen.x = run.x ? path->start + *run.x : pen.x;
    } else {
      pen = Vec2{run.x.value_or(pen.x), run.y.value_or(pen.y)};
    }
    pen = pen + run.shift;
    laid[k].at = pen;
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
