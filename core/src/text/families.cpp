#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "input/svg.hpp"
#include "sillon/text/text.hpp"
#include "text/letters.hpp"

namespace sillon {
namespace {

std::string lowered(std::string_view text) {
  std::string copy(text);
  for (char& c : copy) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return copy;
}

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
  constexpr std::string_view kAround = " \t\r\n\"'";
  bool others = false;
  for (std::string_view rest = families; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string_view family = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    family.remove_prefix(std::min(family.find_first_not_of(kAround), family.size()));
    family = family.substr(0, family.find_last_not_of(kAround) + 1);
    for (const std::string_view font : builtinFonts()) {
      if (lowered(font) == lowered(family)) return {font, others};
    }
    others = others || !family.empty();
  }
  return {lookAlike(lowered(families)), others};
}

}  // namespace

Result<ShapedLine> shapeLineOfDrawing(const ReadInput& read, const std::string& families, const std::string& line) {
  if (mixesSenses(line)) return mixedLine(line);
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
