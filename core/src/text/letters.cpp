#include "text/letters.hpp"

#include <cstdint>
#include <string_view>

#include "sillon/base/words.hpp"
#include "sillon/text/text.hpp"
#include "text/font_names.hpp"

namespace sillon {
namespace {

/// The character that a text in UTF-8 begins with.
std::uint32_t codeOf(std::string_view letter) {
  const auto at = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(letter[k])); };
  std::uint32_t code = letter.empty() ? 0 : letter.size() == 1 ? at(0) : at(0) & (0x7Fu >> letter.size());
  for (std::size_t k = 1; k < letter.size(); ++k) code = code << 6 | (at(k) & 0x3F);
  return code;
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

Error missingLetter(const std::string& font, const std::string& letter) {
  return {ErrorCode::InvalidArgument, "the font " + inQuotes(font) + " has no letter for " + inQuotes(letter) + " (" +
                                          hexOf(codeOf(letter)) + "); take a font that has it, or leave it out"};
}

}  // namespace sillon
