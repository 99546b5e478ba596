#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

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

/// A built-in font that looks a little like the ones of these names.
std::string_view lookAlike(const std::string& families) {
  if (hasAny(families, {"cursive", "script", "hand", "brush"})) return "Caveat";
  if (hasAny(families, {"sans"})) return builtinFonts().front();
  if (hasAny(families, {"serif", "times", "georgia", "garamond", "slab", "courier"})) return "Roboto Slab";
  return builtinFonts().front();
}

struct ChosenFont {
  std::string_view name;
  bool instead = false;  ///< of one that the families name before it
};

ChosenFont chosenFont(std::string_view families) {
  ChosenFont chosen;
  svg::split(families, ',', [&](std::string_view family) {
    family = svg::trimmed(family);
    if (family.size() > 1 && (family.front() == '"' || family.front() == '\''))
      family = family.substr(1, family.size() - 2);
    if (family.empty() || !chosen.name.empty()) return;
    for (const std::string_view font : builtinFonts()) {
      if (svg::lowered(font) == svg::lowered(family)) chosen.name = font;
    }
    chosen.instead = chosen.instead || chosen.name.empty();
  });
  if (chosen.name.empty()) chosen.name = lookAlike(svg::lowered(families));
  return chosen;
}

}  // namespace

Result<ShapedLine> shapeLineOfDrawing(const ReadInput& read, const std::string& families, const std::string& line) {
  const ChosenFont font = chosenFont(families);
  Result<ShapedLine> shaped = shapeLine(read, std::string(font.name), line);
  if (shaped) shaped.value().instead = font.instead;
  return shaped;
}

std::vector<std::string> linesOfDrawing(std::string_view svg) {
  std::vector<std::string> lines;
  SvgOptions options;
  options.letters = [&](const std::string& families, const std::string& line) -> Result<ShapedLine> {
    const std::string name = nameOfLine(std::string(chosenFont(families).name), line);
    if (std::find(lines.begin(), lines.end(), name) == lines.end()) lines.push_back(name);
    return ShapedLine{};
  };
  static_cast<void>(readSvg(svg, options));
  return lines;
}

}  // namespace sillon
