#include "printer_import/slicer_files.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>

namespace sillon {

std::string shown(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, 60)) out += c < ' ' || c > '~' || c == '"' ? '?' : c;
  return out + (text.size() > 60 ? "...\"" : "\"");
}

std::optional<double> firstNumber(std::string_view text) {
  double value = 0;
  text = trimmed(text);
  const auto read = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || !(std::abs(value) < 1e9)) return std::nullopt;
  const std::string_view rest(read.ptr, text.data() + text.size() - read.ptr);
  const bool ends = rest.empty() || rest[0] == ',' || rest[0] == ';' || rest[0] == '%';
  return ends && !rest.starts_with('%') ? std::optional<double>(value) : std::nullopt;
}

std::vector<Vec2> readCorners(std::string_view text) {
  std::vector<Vec2> corners;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view word = trimmed(text.substr(0, comma));
    text.remove_prefix(std::min(comma + 1, text.size()));
    const std::size_t middle = word.find('x');
    if (middle == std::string_view::npos || corners.size() == 1000) return {};
    const auto x = firstNumber(word.substr(0, middle));
    const auto y = firstNumber(word.substr(middle + 1));
    if (!x || !y) return {};
    corners.push_back({*x, *y});
  }
  return corners;
}

std::string unescaped(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '\\' || k + 1 == text.size()) {
      out += text[k];
      continue;
    }
    ++k;
    out += text[k] == 'n' ? '\n' : text[k] == 't' ? ' ' : text[k] == 'r' ? ' ' : text[k];
  }
  return out;
}

namespace {

// Separator of a list: a semicolon between texts, which may hold commas, else a comma.
char separatorOf(std::string_view list) { return list.find_first_of(";\"") != std::string_view::npos ? ';' : ','; }

}  // namespace

std::size_t itemsOf(std::string_view list) { return 1 + std::count(list.begin(), list.end(), separatorOf(list)); }

std::string itemOf(std::string_view list, std::size_t index) {
  const char separator = separatorOf(list);
  std::string_view rest = list;
  for (std::size_t k = 0; k < index; ++k) {
    const std::size_t cut = rest.find(separator);
    if (cut == std::string_view::npos) {
      rest = list;
      break;
    }
    rest.remove_prefix(cut + 1);
  }
  return unescaped(trimmed(rest.substr(0, rest.find(separator))));
}

bool splitSetting(std::string_view line, std::string_view& key, std::string_view& value) {
  const std::size_t equal = line.find('=');
  if (equal == std::string_view::npos) return false;
  key = trimmed(line.substr(0, equal));
  value = trimmed(line.substr(equal + 1));
  const auto isKey = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !key.empty() && key.size() <= 80 && std::all_of(key.begin(), key.end(), isKey);
}

}  // namespace sillon
