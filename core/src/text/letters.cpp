#include "text/letters.hpp"

#include <cstdint>
#include <utility>

#include "sillon/base/words.hpp"
#include "sillon/text/text.hpp"
#include "text/font_names.hpp"

namespace sillon {
namespace {

struct Letter {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
};

/// The character that begins the text; a broken one is one byte long.
Letter firstOf(std::string_view text) {
  const auto at = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k])); };
  const std::uint32_t lead = at(0);
  const std::size_t bytes = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 1;
  if (bytes == 1 || text.size() < bytes) return {lead, 1};
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) code = code << 6 | (at(k) & 0x3F);
  return {code, bytes};
}

/// Hebrew, Arabic and the scripts between and beside them, with their presentation forms.
bool runsToTheLeft(std::uint32_t code) {
  return (code >= 0x590 && code <= 0x8FF) || (code >= 0xFB1D && code <= 0xFDFF) || (code >= 0xFE70 && code <= 0xFEFE) ||
         (code >= 0x10800 && code <= 0x10FFF) || (code >= 0x1E800 && code <= 0x1EFFF);
}

/// Letters that run to the right; digits and signs follow what they stand beside.
bool runsToTheRight(std::uint32_t code) {
  const bool ascii = (code >= 'A' && code <= 'Z') || (code >= 'a' && code <= 'z');
  return ascii || (code >= 0xC0 && code < 0x590) || (code >= 0x900 && code < 0x2000);
}

std::string hexOf(std::uint32_t code) {
  std::string text;
  for (int shift = 20; shift >= 0; shift -= 4) {
    const std::uint32_t digit = code >> shift & 15;
    if (digit != 0 || !text.empty() || shift < 16) text += "0123456789ABCDEF"[digit];
  }
  return "U+" + text;
}

}  // namespace

std::span<const std::string_view> builtinFonts() { return kFontNames; }

Error unknownFont(const std::string& font) {
  std::string known;
  for (const std::string_view name : builtinFonts()) known += (known.empty() ? "" : ", ") + std::string(name);
  return {ErrorCode::InvalidArgument,
          "the font is " + inQuotes(font) + "; it must be a file that is handed over, or one of " + known};
}

std::string nameOfLine(const std::string& font, const std::string& line) { return "line:" + font + "\n" + line; }

Error noFont(const std::string& font) {
  return {ErrorCode::InvalidFile, inQuotes(font) + " is no font; it must be a TrueType or OpenType file (.ttf, .otf)"};
}

Error tooDetailed(const std::string& font, std::size_t most) {
  return {ErrorCode::TooLarge, "the letters of " + inQuotes(font) + " have more than " + std::to_string(most >> 20) +
                                   " MiB of curves; take another font"};
}

Error missingLetter(const std::string& font, std::string_view line, std::size_t byte) {
  const std::string_view rest = line.substr(byte < line.size() ? byte : 0);
  const Letter letter = rest.empty() ? Letter{} : firstOf(rest);
  return {ErrorCode::InvalidArgument, "the font " + inQuotes(font) + " has no letter for " +
                                          inQuotes(std::string(rest.substr(0, letter.bytes))) + " (" +
                                          hexOf(letter.code) + "); take a font that has it, or leave it out"};
}

Error mixedLine(std::string_view line) {
  return {ErrorCode::InvalidArgument,
          "the line " + inQuotes(line) +
              " mixes scripts that run to the left and to the right; give each a line, or a "
              "layer, of its own"};
}

bool mixesSenses(std::string_view line) {
  bool left = false, right = false;
  while (!line.empty()) {
    const Letter letter = firstOf(line);
    left = left || runsToTheLeft(letter.code);
    right = right || runsToTheRight(letter.code);
    line.remove_prefix(letter.bytes);
  }
  return left && right;
}

}  // namespace sillon
