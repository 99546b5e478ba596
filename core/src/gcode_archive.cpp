#include "sillon/gcode_archive.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "inflate.hpp"
#include "stored_zip.hpp"

namespace sillon {
namespace {

constexpr std::size_t kMostPacked = std::size_t{1} << 30;
constexpr std::size_t kMostUnpacked = std::size_t{256} << 20;
constexpr std::size_t kBestDeflate = 1032;  // nothing becomes smaller than this share

// RFC 1321, in upper case.
std::string md5(std::string_view text) {
  constexpr std::array<std::uint32_t, 64> kSines = {
      0xd76aa478, 0xe8c7b756, 0x242070db, 0xc1bdceee, 0xf57c0faf, 0x4787c62a, 0xa8304613, 0xfd469501,
      0x698098d8, 0x8b44f7af, 0xffff5bb1, 0x895cd7be, 0x6b901122, 0xfd987193, 0xa679438e, 0x49b40821,
      0xf61e2562, 0xc040b340, 0x265e5a51, 0xe9b6c7aa, 0xd62f105d, 0x02441453, 0xd8a1e681, 0xe7d3fbc8,
      0x21e1cde6, 0xc33707d6, 0xf4d50d87, 0x455a14ed, 0xa9e3e905, 0xfcefa3f8, 0x676f02d9, 0x8d2a4c8a,
      0xfffa3942, 0x8771f681, 0x6d9d6122, 0xfde5380c, 0xa4beea44, 0x4bdecfa9, 0xf6bb4b60, 0xbebfbc70,
      0x289b7ec6, 0xeaa127fa, 0xd4ef3085, 0x04881d05, 0xd9d4d039, 0xe6db99e5, 0x1fa27cf8, 0xc4ac5665,
      0xf4292244, 0x432aff97, 0xab9423a7, 0xfc93a039, 0x655b59c3, 0x8f0ccc92, 0xffeff47d, 0x85845dd1,
      0x6fa87e4f, 0xfe2ce6e0, 0xa3014314, 0x4e0811a1, 0xf7537e82, 0xbd3af235, 0x2ad7d2bb, 0xeb86d391};
  constexpr int kTurns[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};
  std::string end(text.substr(text.size() / 64 * 64));
  end += '\x80';
  while (end.size() % 64 != 56) end += '\0';
  append(end, 8 * static_cast<std::uint64_t>(text.size()), 8);

  std::uint32_t sum[4] = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  const auto add = [&](const char* block) {
    std::uint32_t words[16];
    for (int k = 0; k < 16; ++k) {
      words[k] = 0;
      for (int byte = 3; byte >= 0; --byte) words[k] = words[k] << 8 | static_cast<std::uint8_t>(block[4 * k + byte]);
    }
    std::uint32_t a = sum[0];
    std::uint32_t b = sum[1];
    std::uint32_t c = sum[2];
    std::uint32_t d = sum[3];
    for (int k = 0; k < 64; ++k) {
      const int round = k / 16;
      const std::uint32_t mix = round == 0   ? (b & c) | (~b & d)
                                : round == 1 ? (d & b) | (~d & c)
                                : round == 2 ? b ^ c ^ d
                                             : c ^ (b | ~d);
      const int word = round == 0 ? k : round == 1 ? 5 * k + 1 : round == 2 ? 3 * k + 5 : 7 * k;
      const std::uint32_t all = a + mix + kSines[static_cast<std::size_t>(k)] + words[word % 16];
      const int turn = kTurns[round][k % 4];
      a = d;
      d = c;
      c = b;
      b += all << turn | all >> (32 - turn);
    }
    sum[0] += a;
    sum[1] += b;
    sum[2] += c;
    sum[3] += d;
  };
  for (std::size_t at = 0; at + 64 <= text.size(); at += 64) add(text.data() + at);
  for (std::size_t at = 0; at < end.size(); at += 64) add(end.data() + at);
  std::string hex;
  for (const std::uint32_t word : sum) {
    for (int byte = 0; byte < 4; ++byte) {
      hex += "0123456789ABCDEF"[word >> (8 * byte + 4) & 15];
      hex += "0123456789ABCDEF"[word >> (8 * byte) & 15];
    }
  }
  return hex;
}

// What follows a key in the comments of the first or the last part of the file; letters, digits and a little more.
std::string told(std::string_view gcode, std::string_view key) {
  constexpr std::size_t kPart = 1 << 20;
  const std::string wanted = "\n; " + std::string(key) + " = ";
  std::string_view part = gcode.substr(gcode.size() - std::min(gcode.size(), kPart));
  std::size_t at = part.rfind(wanted);
  if (at == std::string_view::npos) {
    part = gcode.substr(0, kPart);
    at = part.find(wanted);
  }
  std::string out;
  if (at == std::string_view::npos) return out;
  for (const char c : part.substr(at + wanted.size(), 60)) {
    if (c == '\n' || c == '\r') break;
    const bool good = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' ||
                      c == ' ' || c == '-' || c == '+';
    if (good) out += c;
  }
  return out;
}

// "1h 2m 3s" in seconds.
std::uint64_t seconds(std::string_view text) {
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

// The largest PNG of the header's thumbnails; empty if there is none.
std::string picture(std::string_view gcode) {
  constexpr std::string_view kBegin = "\n; thumbnail begin ";
  constexpr std::string_view kEnd = "; thumbnail end";
  std::string_view largest;
  std::string_view rest = gcode.substr(0, 1 << 20);
  for (std::size_t at = rest.find(kBegin); at != std::string_view::npos; at = rest.find(kBegin)) {
    rest.remove_prefix(at + kBegin.size());
    const std::size_t end = rest.find(kEnd);
    const std::size_t line = rest.find('\n');
    if (end == std::string_view::npos || line > end) break;
    const std::string_view rows = rest.substr(line, end - line);
    if (rows.size() > largest.size()) largest = rows;
  }
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : largest) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) continue;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes.starts_with("\x89PNG") ? bytes : "";
}

std::string metadata(std::string_view key, const std::string& value) {
  return "    <metadata key=\"" + std::string(key) + "\" value=\"" + value + "\"/>\n";
}

std::string sliceInfo(std::string_view gcode) {
  const std::string mm = told(gcode, "filament used [mm]");
  std::string out = std::string(kXml) + "<config>\n  <plate>\n" + metadata("index", "1");
  out += metadata("nozzle_diameters", told(gcode, "nozzle_diameter"));
  out += metadata("prediction", std::to_string(seconds(told(gcode, "estimated printing time (normal mode)"))));
  out += metadata("weight", told(gcode, "total filament used [g]"));
  out += metadata("outside", "false") + metadata("support_used", "false");
  return out + "    <filament id=\"1\" type=\"" + told(gcode, "filament_type") + "\" color=\"#FFFFFF\" used_g=\"" +
         told(gcode, "total filament used [g]") + "\"/>\n  </plate>\n</config>\n";
}

std::uint64_t number(std::string_view bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int k = count - 1; k >= 0; --k)
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + static_cast<std::size_t>(k)]);
  return value;
}

Error damaged(const char* what) { return {ErrorCode::InvalidFile, std::string("the .gcode.3mf ") + what}; }

}  // namespace

Result<std::string> packGcode(std::string_view gcode) {
  if (gcode.size() > kMostPacked) {
    return Error{ErrorCode::TooLarge, "the G-code is " + std::to_string(gcode.size() >> 20) +
                                          " MiB; in a .gcode.3mf it must be at most 1024"};
  }
  const std::string png = picture(gcode);
  Zip zip;
  addPackageParts(zip,
                  " <Default Extension=\"png\" ContentType=\"image/png\"/>\n"
                  " <Default Extension=\"gcode\" ContentType=\"text/x.gcode\"/>\n");
  zip.add("3D/3dmodel.model",
          std::string(kXml) +
              "<model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
              " <metadata name=\"Application\">Sillon</metadata>\n <resources/>\n <build/>\n</model>\n");
  zip.add("Metadata/model_settings.config",
          std::string(kXml) + "<config>\n  <plate>\n" + metadata("plater_id", "1") +
              metadata("gcode_file", "Metadata/plate_1.gcode") +
              (png.empty() ? "" : metadata("thumbnail_file", "Metadata/plate_1.png")) + "  </plate>\n</config>\n");
  zip.add("Metadata/_rels/model_settings.config.rels",
          std::string(kXml) +
              "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
              " <Relationship Target=\"/Metadata/plate_1.gcode\" Id=\"rel-1\" "
              "Type=\"http://schemas.bambulab.com/package/2021/gcode\"/>\n</Relationships>\n");
  zip.add("Metadata/slice_info.config", sliceInfo(gcode));
  if (!png.empty()) zip.add("Metadata/plate_1.png", png);
  zip.add("Metadata/plate_1.gcode.md5", md5(gcode));
  zip.add("Metadata/plate_1.gcode", gcode);
  return zip.finish();
}

Result<std::string> unpackGcode(std::string_view bytes) {
  if (!bytes.starts_with("PK\x03\x04")) return std::string(bytes);
  constexpr std::size_t kEndSize = 22;
  constexpr std::size_t kMostComment = 65535;
  const std::size_t from = bytes.size() - std::min(bytes.size(), kEndSize + kMostComment);
  const std::size_t last = bytes.substr(from).rfind("PK\x05\x06");
  if (last == std::string_view::npos || from + last + kEndSize > bytes.size()) return damaged("is cut off");
  const std::size_t end = from + last;
  const std::uint64_t count = number(bytes, end + 10, 2);
  std::uint64_t at = number(bytes, end + 16, 4);
  std::string_view best;  // name of the first plate
  std::size_t entry = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    if (at + 46 > end || number(bytes, static_cast<std::size_t>(at), 4) != 0x02014b50)
      return damaged("has a broken directory");
    const auto here = static_cast<std::size_t>(at);
    const std::uint64_t name = number(bytes, here + 28, 2);
    if (at + 46 + name > end) return damaged("has a broken directory");
    const std::string_view text = bytes.substr(here + 46, static_cast<std::size_t>(name));
    const bool shorter =
        text.size() != best.size() ? text.size() < best.size() : text < best;  // plate_2 before plate_10
    if (text.ends_with(".gcode") && (best.empty() || shorter)) {
      best = text;
      entry = here;
    }
    at += 46 + name + number(bytes, here + 30, 2) + number(bytes, here + 32, 2);
  }
  if (best.empty()) return damaged("holds no .gcode; slice the plate before it is exported");
  const std::uint64_t flags = number(bytes, entry + 8, 2);
  const std::uint64_t method = number(bytes, entry + 10, 2);
  const std::uint64_t packed = number(bytes, entry + 20, 4);
  const std::uint64_t size = number(bytes, entry + 24, 4);
  const std::uint64_t local = number(bytes, entry + 42, 4);
  if ((flags & 1) != 0) return damaged("is encrypted");
  if (method != 0 && method != 8) return damaged("is packed in an unknown way");
  if (size > kMostUnpacked) {
    return Error{ErrorCode::TooLarge,
                 "the G-code in the .gcode.3mf is " + std::to_string(size >> 20) + " MiB; it must be at most 256"};
  }
  if (local + 30 > bytes.size() || number(bytes, static_cast<std::size_t>(local), 4) != 0x04034b50) {
    return damaged("has a broken entry");
  }
  const auto head = static_cast<std::size_t>(local);
  const std::uint64_t data = local + 30 + number(bytes, head + 26, 2) + number(bytes, head + 28, 2);
  if (data + packed > bytes.size() || size > packed * kBestDeflate || (method == 0 && size != packed)) {
    return damaged("has a broken entry");
  }
  // stb_image's inflate looks 4 bytes beyond the end; the directory follows there.
  const auto begin = static_cast<std::size_t>(data);
  const auto length = static_cast<std::size_t>(packed);
  std::optional<std::string> out = method == 0
                                       ? std::string(bytes.substr(begin, length))
                                       : inflated(bytes.substr(begin, length + 4), static_cast<std::size_t>(size));
  if (!out || crc32(*out) != number(bytes, entry + 16, 4)) return damaged("is damaged: its checksum does not fit");
  return std::move(*out);
}

}  // namespace sillon
