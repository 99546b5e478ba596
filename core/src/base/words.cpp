#include "base/words.hpp"

#include <algorithm>
#include <cstddef>

namespace sillon {
namespace {

/// Levenshtein distance; both texts are short.
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

}  // namespace

std::string inQuotes(std::string_view text) {
  constexpr std::size_t kShown = 60;
  std::string out = "\"";
  for (std::size_t k = 0; k < text.size() && k < kShown; ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    out += byte < 0x20 || byte == 0x7f || byte == '"' ? '?' : text[k];
  }
  // A cut through a UTF-8 character would leave half of it.
  if (text.size() > kShown) {
    while ((static_cast<unsigned char>(out.back()) & 0xC0) == 0x80) out.pop_back();
    if (static_cast<unsigned char>(out.back()) >= 0xC0) out.pop_back();
    out += "...";
  }
  return out + "\"";
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kNear = 3;
  std::vector<std::string> near;
  for (std::size_t distance = 0; distance <= kNear; ++distance) {
    for (const std::string& name : known) {
      if (near.size() == 3 || distance >= name.size()) continue;
      if (editDistance(word.substr(0, 64), name) == distance) near.push_back(name);
    }
  }
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
