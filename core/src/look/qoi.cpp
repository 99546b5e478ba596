#include "look/preview_parts.hpp"

namespace sillon {
namespace {

constexpr int kLongestRun = 62;  // longest run of one code: the two longer ones would be other codes

// The format counts in pixels with alpha, which is always opaque here.
struct Pixel {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  std::uint8_t a = 255;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

}  // namespace

// Header: magic, both sides as 32 bits with the highest byte first, channels and colour space.
std::vector<std::uint8_t> encodeQoi(int width, int height, std::span<const std::uint8_t> rgb) {
  std::vector<std::uint8_t> out{'q', 'o', 'i', 'f'};
  const auto byte = [&](int value) { out.push_back(static_cast<std::uint8_t>(value)); };
  for (const int side : {width, height}) {
    for (int shift = 24; shift >= 0; shift -= 8) byte(side >> shift & 255);
  }
  byte(3);  // channels
  byte(0);  // sRGB

  // Colours seen lately, by hash. At first they are transparent, which no pixel here is.
  std::array<Pixel, 64> seen{};
  for (Pixel& colour : seen) colour.a = 0;
  Pixel before;
  int run = 0;
  for (std::size_t k = 0; k + 2 < rgb.size(); k += 3) {
    const Pixel now{rgb[k], rgb[k + 1], rgb[k + 2]};
    // A run of the same pixel.
    if (now == before) {
      if (++run == kLongestRun) byte(0xC0 | (run - 1)), run = 0;
      continue;
    }
    if (run > 0) byte(0xC0 | (run - 1)), run = 0;
    const int hash = (now.r * 3 + now.g * 5 + now.b * 7 + now.a * 11) % 64;
    // Differences wrap around, as the format says: -128 to 127.
    const auto step = [](int to, int from) { return ((to - from + 128) & 255) - 128; };
    const int dr = step(now.r, before.r);
    const int dg = step(now.g, before.g);
    const int db = step(now.b, before.b);
    const auto small = [](int d) { return d >= -2 && d <= 1; };
    const auto near = [&](int d) { return d - dg >= -8 && d - dg <= 7; };
    // Else the shortest code that fits: a colour seen before, a small difference, a difference relative to green, or
    // all three channels.
    if (seen[hash] == now) {
      byte(hash);
    } else if (small(dr) && small(dg) && small(db)) {
      byte(0x40 | (dr + 2) << 4 | (dg + 2) << 2 | (db + 2));
    } else if (dg >= -32 && dg <= 31 && near(dr) && near(db)) {
      byte(0x80 | (dg + 32));
      byte((dr - dg + 8) << 4 | (db - dg + 8));
    } else {
      byte(0xFE);
      byte(now.r);
      byte(now.g);
      byte(now.b);
    }
    seen[hash] = now;
    before = now;
  }
  // The last run, then the end mark: seven zeros and a one.
  if (run > 0) byte(0xC0 | (run - 1));
  for (int k = 0; k < 7; ++k) byte(0);
  byte(1);
  return out;
}

}  // namespace sillon
