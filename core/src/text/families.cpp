#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "input/shaped_line.hpp"
#include "input/svg.hpp"
#include "input/svg/svg_reader.hpp"
#include "sillon/text/text.hpp"
#include "text/letters.hpp"

namespace sillon {
namespace {

bool hasAny(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

/// Returns a built-in font that looks somewhat like the fonts of these families.
std::string_view lookAlike(const std::string& families) {
  if (hasAny(families, {"cursive", "script", "hand", "brush"})) return "Caveat";
  if (hasAny(families, {"sans"})) return builtinFonts().front();
  if (hasAny(families, {"serif", "times", "georgia", "garamond", "slab", "courier"})) return "Roboto Slab";
  return builtinFonts().front();
}

bool isSameName(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char one, char other) { return svg::lower(one) == svg::lower(other); });
}

}  // namespace

DrawingFont fontOfDrawing(std::string_view families) {
  DrawingFont chosen;
  svg::split(families, ',', [&](std::string_view family) {
    family = svg::trimmed(family);
    if (family.size() > 1 && (family.front() == '"' || family.front() == '\''))
      family = family.substr(1, family.size() - 2);
    if (family.empty() || !chosen.name.empty()) return;
    for (const std::string_view font : builtinFonts()) {
      if (isSameName(font, family)) chosen.name = font;
    }
    chosen.instead = chosen.instead || chosen.name.empty();
  });
  if (chosen.name.empty()) chosen.name = lookAlike(svg::lowered(families));
  return chosen;
}

Result<ShapedLine> shapeLineOfDrawing(const ReadInput& read, const DrawingFont& font, const std::string& line) {
  Result<ShapedLine> shaped = shapeLine(read, font.name, line);
  if (shaped) shaped.value().instead = font.instead;
  return shaped;
}

std::vector<std::string> linesOfDrawing(std::string_view svg) {
  std::vector<std::string> lines;
  SvgOptions options;
  options.letters.choose = fontOfDrawing;
  options.letters.shape = [&](const DrawingFont& font, const std::string& line) -> Result<ShapedLine> {
    lines.push_back(nameOfLine(font.name, 0, line));  // each line is asked for once
    ShapedLine shown;  // dummy letters, because a drawing that shows nothing would be read again
    shown.letters.emplace_back();
    shown.outlines.emplace_back("M0 0H1V1Z");
    return shown;
  };
  const Result<Shape> read = readSvg(svg, options);
  // Such letters may lie outside the page while the real ones do not, so that EmptyShape is ignored. If the drawing is
  // refused for another reason, no line needs to be shaped.
  if (!read && read.error().code != ErrorCode::EmptyShape) lines.clear();
  return lines;
}

}  // namespace sillon
