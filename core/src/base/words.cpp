#include "sillon/base/words.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sillon {
namespace {

/// Returns the Levenshtein distance; both texts are short.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

/// Keeps letters and digits only, in lower case.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool capital = c >= 'A' && c <= 'Z';
    if (capital || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) out += static_cast<char>(capital ? c + 32 : c);
  }
  return out;
}

/// Decodes the character at the beginning of a text in UTF-8.
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

std::string inQuotes(std::string_view text) {
  constexpr std::size_t kShown = 60;
  std::string out = "\"";
  for (std::size_t k = 0; k < text.size() && k < kShown; ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    out += byte < 0x20 || byte == 0x7f || byte == '"' ? '?' : text[k];
  }
  // Removes the rest of a UTF-8 character that was cut through.
  if (text.size() > kShown) {
    while ((static_cast<unsigned char>(out.back()) & 0xC0) == 0x80) out.pop_back();
    if (static_cast<unsigned char>(out.back()) >= 0xC0) out.pop_back();
    out += "...";
  }
  return out + "\"";
}

std::string letterWithCode(std::string_view letter) { return inQuotes(letter) + " (" + hexOf(codeOf(letter)) + ")"; }

std::vector<std::string> nearNames(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kMost = 3;
  constexpr std::size_t kTelling = 4;  // letters; shorter parts occur in too many names
  word = word.substr(0, 64);
  std::vector<std::string> near;
  const auto add = [&](const std::string& name) {
    if (near.size() < kMost && std::find(near.begin(), near.end(), name) == near.end()) near.push_back(name);
  };
  const std::string part = plain(word);
  for (const std::string& name : known) {
    if (part.size() >= kTelling && plain(name).find(part) != std::string::npos) add(name);
  }
  // A name that differs in more than half of the word's letters is no misspelling of it.
  const std::size_t farthest = std::min<std::size_t>(3, word.size() / 2);
  for (std::size_t distance = 0; distance <= farthest; ++distance) {
    for (const std::string& name : known) {
      if (distance < name.size() && editDistance(word, name) == distance) add(name);
    }
  }
  return near;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const std::vector<std::string> near = nearNames(word, known);
  std::string out = near.empty() ? "known are " : "did you mean ";
  if (near.empty()) {
    for (std::size_t k = 0; k < known.size(); ++k) out += (k == 0 ? "" : ", ") + known[k];
  } else {
    for (std::size_t k = 0; k < near.size(); ++k) out += (k == 0 ? "" : " or ") + inQuotes(near[k]);
    out += "?";
  }
  return out;
}

}  // namespace sillon
