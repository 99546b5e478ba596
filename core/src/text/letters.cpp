#include "text/letters.hpp"

#include <algorithm>
#include <string_view>

#include "base/refused.hpp"
#include "sillon/base/words.hpp"
#include "text/font_names.hpp"

namespace sillon {

std::span<const std::string_view> builtinFonts() { return kFontNames; }

Error unknownFont(const std::string& font) {
  std::string known;
  for (const std::string_view name : builtinFonts()) known += (known.empty() ? "" : ", ") + std::string(name);
  return refusedArgument("UnknownFont", {{"font", inQuotes(font)}, {"known", known}});
}

std::string nameOfLine(const std::string& font, int weight, const std::string& line) {
  return "line:" + font + (weight > 0 ? '\t' + std::to_string(weight) : std::string()) + '\n' + line;
}

Error noFont(const std::string& font) { return refusedFile("NoFont", {{"font", inQuotes(font)}}); }

Error tooDetailed(const std::string& font, std::size_t most) {
  return refused(ErrorCode::TooLarge, "FontTooDetailed", {{"font", inQuotes(font)}, {"megabytes", most >> 20}});
}

Error missingLetter(const std::string& font, const LackedLetter& lacked) {
  const std::string letter = letterWithCode(lacked.letter);
  return lacked.picture
             ? refused(ErrorCode::InvalidArgument, "PictureLetter", {{"font", inQuotes(font)}, {"letter", letter}})
             : refused(ErrorCode::InvalidArgument, "MissingLetter", {{"letter", letter}});
}

void addLacked(std::vector<LackedLetter>& all, const LackedLetter& one) {
  const auto alike = [&](const LackedLetter& other) { return other.font.empty() == one.font.empty(); };
  const auto same = [&](const LackedLetter& other) { return other.letter == one.letter && other.font == one.font; };
  if (std::count_if(all.begin(), all.end(), alike) < kMostLackedTold && std::none_of(all.begin(), all.end(), same)) {
    all.push_back(one);
  }
}

}  // namespace sillon
