#include "export/packing.hpp"

#include <array>

namespace sillon {

std::string md5(std::string_view text) { return md5(std::vector<std::string_view>{text}); }

std::string md5(const std::vector<std::string_view>& parts) {
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
      const std::uint32_t all = a + mix + kSines[k] + words[word % 16];
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
  std::string kept;  // bytes of an unfinished block; at the end the last one or two blocks
  std::uint64_t size = 0;
  for (std::string_view part : parts) {
    size += part.size();
    if (!kept.empty()) {
      const std::string_view more = part.substr(0, 64 - kept.size());
      kept += more;
      part.remove_prefix(more.size());
      if (kept.size() < 64) continue;
      add(kept.data());
      kept.clear();
    }
    for (; part.size() >= 64; part.remove_prefix(64)) add(part.data());
    kept = part;
  }
  kept += '\x80';
  while (kept.size() % 64 != 56) kept += '\0';
  append(kept, 8 * size, 8);
  for (std::size_t at = 0; at < kept.size(); at += 64) add(kept.data() + at);
  std::string hex;
  for (const std::uint32_t word : sum) {
    for (int byte = 0; byte < 4; ++byte) {
      hex += "0123456789ABCDEF"[word >> (8 * byte + 4) & 15];
      hex += "0123456789ABCDEF"[word >> (8 * byte) & 15];
    }
  }
  return hex;
}

}  // namespace sillon
