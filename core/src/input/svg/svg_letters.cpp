#include "input/svg/svg_letters.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sillon::svg {
namespace {

/// Numbers of an attribute, one for each letter, in user units.
std::vector<double> lengthsOf(const Node& node, const char* name, double full, const UserUnits& units) {
  std::vector<double> lengths;
  std::string_view rest = attribute(node, name).value_or("");
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(", \t\r\n"), rest.size());
    if (end > 0) {
      const double length = units.ofStyle(rest.substr(0, end), full);
      if (!std::isfinite(length)) {
        refuse(std::string(name) + " is " + quoted(*attribute(node, name)) + "; it must be lengths");
      }
      lengths.push_back(length);
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

void setSize(std::string_view value, const PaintContext& context, double& size) {
  std::string_view rest;
  const std::optional<double> number = leadingNumber(value, rest);
  if (!number) return;
  const std::string unit = lowered(rest);
  const double inherited = size > 0 ? size : context.length("16px");
  const double share = unit == "em" ? 1 : unit == "ex" ? 0.5 : unit == "%" ? 0.01 : 0;
  const double length = share > 0 ? *number * share * inherited : context.length(value);
  if (length > 0) size = length;
}

/// `font: italic bold 12px/1.4 Arial, sans-serif`.
void setFont(std::string_view value, const PaintContext& context, LetterStyle& letters) {
  while (!(value = trimmed(value)).empty()) {
    const std::size_t end = std::min(value.find_first_of(" \t\r\n"), value.size());
    const std::string_view token = value.substr(0, end);
    value.remove_prefix(end);
    // Weights are numbers, too, but without a unit.
    if (!isDigit(token.front()) || token.find_first_not_of("0123456789") == std::string_view::npos) continue;
    setSize(token.substr(0, token.find('/')), context, letters.size);
    if (const std::string_view families = trimmed(value); !families.empty()) letters.families = families;
    return;
  }
}

}  // namespace

void applyLetters(const Style& style, const PaintContext& context, LetterStyle& letters) {
  setFont(style.value(Property::Font), context, letters);
  setSize(style.value(Property::FontSize), context, letters.size);
  const std::string& families = style.value(Property::FontFamily);
  if (!families.empty() && lowered(families) != "inherit") letters.families = families;
  const std::string anchor = style.word(Property::TextAnchor);
  if (anchor == "start") letters.anchor = 0;
  if (anchor == "middle") letters.anchor = 0.5;
  if (anchor == "end") letters.anchor = 1;
  const std::string& spacing = style.value(Property::LetterSpacing);
  if (lowered(spacing) == "normal") letters.spacing = 0;
  if (const double length = context.length(spacing); std::isfinite(length)) letters.spacing = length;
  const std::string baseline = style.word(Property::DominantBaseline);
  if (baseline == "middle" || baseline == "central") letters.hang = 0.5;
  if (baseline == "hanging" || baseline == "text-before-edge" || baseline == "text-top") letters.hang = 1;
}

bool hasSpaceBefore(const Node& child) {
  // Behind text it is the end of that text, whose terminator the parser has put in place of this element's "<".
  const Node* const before = child.previous_sibling();
  if (before == nullptr || before->type() != rapidxml::node_element) return false;
  const char* at = child.name();
  while (*(at - 1) != '<') --at;  // over the prefix of its namespace
  return isSpace(*(at - 2));
}

void LetterRuns::begin(const Node& node, Vec2 viewport, const UserUnits& units) {
  std::vector<double> xs = lengthsOf(node, "x", viewport.x, units), ys = lengthsOf(node, "y", viewport.y, units);
  if (!xs.empty() || !ys.empty()) {
    xs_ = std::move(xs);
    ys_ = std::move(ys);
    next_ = 0;
    trim();
  }
  const std::vector<double> dx = lengthsOf(node, "dx", viewport.x, units);
  const std::vector<double> dy = lengthsOf(node, "dy", viewport.y, units);
  if (!dx.empty()) shift_.x += dx.front();
  if (!dy.empty()) shift_.y += dy.front();
}

void LetterRuns::add(std::string_view text, const PaintState& paint, bool keepsSpaces) {
  std::string shown;
  for (const char c : text) {
    const bool space = isSpace(c);
    if (space && afterSpace_ && !keepsSpaces) continue;
    afterSpace_ = space;
    shown += space ? ' ' : c;
  }
  // Letters with places of their own come one by one, the rest in one run.
  std::string_view rest = shown;
  while (next_ + 1 < std::max(xs_.size(), ys_.size()) && !rest.empty()) {
    const std::size_t bytes = bytesOfLetter(rest);
    push(std::string(rest.substr(0, bytes)), paint);
    rest.remove_prefix(bytes);
  }
  if (!rest.empty()) push(std::string(rest), paint);
}

void LetterRuns::push(std::string text, const PaintState& paint) {
  LetterRun run{std::move(text), paint, {}, {}, std::exchange(shift_, {})};
  if (next_ < xs_.size()) run.x = xs_[next_];
  if (next_ < ys_.size()) run.y = ys_[next_];
  ++next_;
  runs_.push_back(std::move(run));
}

void LetterRuns::trim() {
  if (!runs_.empty() && runs_.back().text.ends_with(' ')) runs_.back().text.pop_back();
  afterSpace_ = true;
}

std::vector<LetterRun> LetterRuns::take() {
  trim();
  return std::exchange(runs_, {});
}

Result<std::vector<PlacedLetter>> placeLetters(const std::vector<LetterRun>& runs, const ShapeLetters& shape,
                                               const UserUnits& units) {
  std::vector<ShapedLine> lines;
  std::vector<double> widths, scales;
  for (const LetterRun& run : runs) {
    lines.emplace_back();
    if (!run.text.empty()) {
      Result<ShapedLine> line = shape(run.paint.letters.families, run.text);
      if (!line) return line.error();
      lines.back() = std::move(line).value();
    }
    const LetterStyle& style = run.paint.letters;
    scales.push_back((style.size > 0 ? style.size : units.ofStyle("16px", 0)) / lines.back().em);
    double width = run.shift.x;
    for (const ShapedLine::Letter& letter : lines.back().letters)
      width += letter.advance * scales.back() + style.spacing;
    widths.push_back(width);
  }

  std::vector<PlacedLetter> placed;
  Vec2 pen;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const LetterStyle& style = runs[k].paint.letters;
    if (runs[k].y) pen.y = *runs[k].y;
    if (runs[k].x) pen.x = *runs[k].x;
    if (runs[k].x || runs[k].y || k == 0) {
      // An anchored line ends before the next run with a place of its own.
      double width = widths[k];
      for (std::size_t next = k + 1; next < runs.size() && !runs[next].x && !runs[next].y; ++next)
        width += widths[next];
      pen.x -= style.anchor * width;
    }
    pen = pen + runs[k].shift;
    const double scale = scales[k];
    for (const ShapedLine::Letter& letter : lines[k].letters) {
      const double x = pen.x + letter.offset.x * scale;
      const double y = pen.y - letter.offset.y * scale + style.hang * lines[k].capHeight * scale;
      placed.push_back({lines[k].outlines[letter.outline], matrix(scale, 0, 0, -scale, x, y), k});
      pen.x += letter.advance * scale + style.spacing;
    }
  }
  return placed;
}

}  // namespace sillon::svg
