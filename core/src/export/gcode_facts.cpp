#include "export/packing.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/lines.hpp"
#include "gcode_reader/layers.hpp"

namespace sillon {
namespace {

bool isPlain(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' || c == ' ' ||
         c == '-' || c == '+' || c == '#';
}

// Decodes Base64; all other characters, such as "; " and line ends, are skipped.
std::string unpackBase64(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) continue;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

// Reads the size of a picture, such as 32 and 24 from "32x24 1234".
bool readSize(std::string_view text, ToldPicture& picture) {
  const auto read = [&](int& out) {
    std::size_t digits = 0;
    for (out = 0; digits < text.size() && digits < 4 && text[digits] >= '0' && text[digits] <= '9'; ++digits) {
      out = 10 * out + (text[digits] - '0');
    }
    text.remove_prefix(digits);
    return digits > 0;
  };
  if (!read(picture.width) || !text.starts_with('x')) return false;
  text.remove_prefix(1);
  return read(picture.height);
}

// Value of a word of G-code, such as X1.5.
std::optional<double> word(std::string_view line, char letter) {
  const std::size_t at = line.find(std::string{' ', letter});
  double value = 0;
  if (at == std::string_view::npos) return std::nullopt;
  const auto read = fast_float::from_chars(line.data() + at + 2, line.data() + line.size(), value);
  return read.ec == std::errc{} ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

std::string toldValue(std::string_view gcode, std::string_view key, std::string_view before, std::size_t item) {
  const std::string_view parts[] = {gcode.substr(gcode.size() - std::min(gcode.size(), kTold)), gcode.substr(0, kTold)};
  for (const std::string_view part : parts) {
    for (const char* joint : {" = ", " : ", ": "}) {
      const std::string wanted = std::string(before) + "; " + std::string(key) + joint;
      const std::size_t at = part.rfind(wanted);
      if (at == std::string_view::npos) continue;
      std::string out;
      std::size_t read = 0;
      for (const char c : part.substr(at + wanted.size(), 60 * (item + 1))) {
        if (c == '\n' || c == '\r') break;
        if (c == ';' || c == ',') {
          if (read++ == item) break;
          out.clear();
        } else if (isPlain(c)) {
          out += c;
        }
      }
      return out;
    }
  }
  return "";
}

std::uint64_t toldSeconds(std::string_view text) {
  std::uint64_t sum = 0;
  std::uint64_t number = 0;
  for (const char c : text) {
    if (c >= '0' && c <= '9') {
      number = std::min<std::uint64_t>(number * 10 + static_cast<std::uint64_t>(c - '0'), 1'000'000'000);
    } else if (c != ' ') {
      sum += number * (c == 'd' ? 86400 : c == 'h' ? 3600 : c == 'm' ? 60 : 1);
      number = 0;
    }
  }
  return sum;
}

std::optional<double> plainNumber(std::string_view text) {
  double value = 0;
  const auto read = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
  return whole && std::abs(value) < 1e12 ? std::optional<double>(value) : std::nullopt;
}

std::vector<ToldPicture> toldPictures(std::string_view gcode) {
  const std::pair<std::string_view, const char*> kinds[] = {
      {"\n; thumbnail begin ", "PNG"}, {"\n; thumbnail_JPG begin ", "JPG"}, {"\n; thumbnail_QOI begin ", "QOI"}};
  constexpr std::string_view kBegin = "\n; thumbnail";
  constexpr std::string_view kEnd = " end";
  std::vector<ToldPicture> pictures;
  std::string_view rest = gcode.substr(0, kTold);
  for (std::size_t at = rest.find(kBegin); at != std::string_view::npos; at = rest.find(kBegin)) {
    rest.remove_prefix(at);
    const auto* kind =
        std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& one) { return rest.starts_with(one.first); });
    if (kind == std::end(kinds)) {
      rest.remove_prefix(1);
      continue;
    }
    rest.remove_prefix(kind->first.size());
    const std::size_t end = rest.find("; thumbnail");
    const std::size_t line = rest.find('\n');
    if (end == std::string_view::npos || line > end) break;
    ToldPicture picture;
    picture.format = kind->second;
    picture.bytes = unpackBase64(rest.substr(line, end - line));
    if (readSize(rest, picture) && !picture.bytes.empty()) pictures.push_back(std::move(picture));
    rest.remove_prefix(std::min(rest.find(kEnd, end), rest.size()));
  }
  return pictures;
}

Bounds printedBox(const std::vector<std::string_view>& gcode) {
  Bounds box;
  Vec2 at;
  bool layer = false;
  bool custom = false;
  const auto run = [&](std::string_view line) {
    if (line.starts_with(";")) {
      layer = layer || layerMark(trimmed(line.substr(1))) != LayerMark::None;
      if (line.starts_with(";TYPE:")) custom = line.starts_with(";TYPE:Custom");
      if (line.starts_with("; FEATURE: ")) custom = line.starts_with("; FEATURE: Custom");
    }
    if (!line.starts_with("G0 ") && !line.starts_with("G1 ") && !line.starts_with("G2 ") && !line.starts_with("G3 ")) {
      return;
    }
    const auto x = word(line, 'X');
    const auto y = word(line, 'Y');
    if (!x && !y) return;
    const Vec2 from = at;
    at = {x.value_or(at.x), y.value_or(at.y)};
    const auto e = word(line, 'E');
    if (!layer || custom || !e || !(*e > 0)) return;
    box.add(from);
    box.add(at);
  };
  for (std::string_view part : gcode) {
    while (!part.empty()) run(nextLine(part));
  }
  return box;
}

}  // namespace sillon
