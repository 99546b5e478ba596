// Predicts whether a damaged QR code can be read. Its content is known here, so that no decoder is needed: only the
// reach of the error correction matters.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "text/qr_code.hpp"

namespace sillon {
namespace {

constexpr int kMostVersions = 40;
using PerVersion = std::array<std::uint8_t, kMostVersions>;

// Correction codewords per block, by level from low to high and by version from 1 (ISO/IEC 18004, table 9).
constexpr std::array<PerVersion, 4> kCorrectionWords{{
    {7,  10, 15, 20, 26, 18, 20, 24, 30, 18, 20, 24, 26, 30, 22, 24, 28, 30, 28, 28,
     28, 28, 30, 30, 26, 28, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30},
    {10, 16, 26, 18, 24, 16, 18, 22, 22, 26, 30, 22, 22, 24, 24, 28, 28, 26, 26, 26,
     26, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28},
    {13, 22, 18, 26, 18, 24, 18, 22, 20, 24, 28, 26, 24, 20, 30, 24, 28, 28, 26, 30,
     28, 30, 30, 30, 30, 28, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30},
    {17, 28, 22, 16, 22, 28, 26, 26, 24, 28, 24, 28, 22, 24, 24, 30, 28, 28, 26, 28,
     30, 24, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30},
}};
constexpr std::array<PerVersion, 4> kBlocks{{
    {1, 1, 1, 1,  1,  2,  2,  2,  2,  4,  4,  4,  4,  4,  6,  6,  6,  6,  7,  8,
     8, 9, 9, 10, 12, 12, 12, 13, 14, 15, 16, 17, 18, 19, 19, 20, 21, 22, 24, 25},
    {1,  1,  1,  2,  2,  4,  4,  4,  5,  5,  5,  8,  9,  9,  10, 10, 11, 13, 14, 16,
     17, 17, 18, 20, 21, 23, 25, 26, 28, 29, 31, 33, 35, 37, 38, 40, 43, 45, 47, 49},
    {1,  1,  2,  2,  4,  4,  6,  6,  8,  8,  8,  10, 12, 16, 12, 17, 16, 18, 21, 20,
     23, 23, 25, 27, 29, 34, 34, 35, 38, 40, 43, 45, 48, 51, 53, 56, 59, 62, 65, 68},
    {1,  1,  2,  4,  4,  4,  5,  6,  8,  8,  11, 11, 16, 16, 18, 16, 19, 21, 25, 25,
     25, 34, 30, 32, 35, 37, 40, 42, 45, 48, 51, 54, 57, 60, 63, 66, 70, 74, 77, 81},
}};

/// Reading of a code. Modules are counted from the code's upper left corner, without the quiet zone.
class CodeReading {
 public:
  CodeReading(const Image& code, const std::vector<char>& wrong)
      : code_(code), wrong_(wrong), side_(code.width - 2 * kQuietZone), version_((side_ - 17) / 4) {}

  [[nodiscard]] bool succeeds() const { return findersShow() && formatReads() && blocksRead(); }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const { return indexOf(x + kQuietZone, y + kQuietZone, code_.width); }
  [[nodiscard]] bool wrong(int x, int y) const { return wrong_[at(x, y)] != 0; }
  [[nodiscard]] int dark(int x, int y) const { return code_.samples[at(x, y)] == 0 ? 1 : 0; }

  /// Tells whether the three finder patterns are intact. Decoders look for runs of 1:1:3:1:1 on lines through the
  /// middle of a pattern, with light at either end, and then for its corners.
  [[nodiscard]] bool findersShow() const {
    for (const auto& [left, top] : {std::array{0, 0}, {side_ - 7, 0}, {0, side_ - 7}}) {
      for (int line = 0; line < 7; ++line) {
        const int beyond = line >= 2 && line <= 4 ? 1 : 0;
        for (int k = -beyond; k < 7 + beyond; ++k) {
          if (wrong(left + k, top + line) || wrong(left + line, top + k)) return false;
        }
      }
    }
    return true;
  }

  /// Tells whether one of the two copies of the format can be corrected.
  [[nodiscard]] bool formatReads() const {
    constexpr int kCorrected = 3;
    int first = 0, second = 0;
    for (int k = 0; k < 9; ++k) {
      if (k != 6) first += (wrong(8, k) ? 1 : 0) + (k != 8 && wrong(k, 8) ? 1 : 0);
    }
    for (int k = 1; k <= 8; ++k) second += (wrong(side_ - k, 8) ? 1 : 0) + (k != 8 && wrong(8, side_ - k) ? 1 : 0);
    return std::min(first, second) <= kCorrected;
  }

  /// Returns the index of the alignment patterns' column or row that contains a module, or -1.
  [[nodiscard]] int alignment(int place) const {
    const int gaps = version_ / 7 + 1;
    const int step = version_ == 32 ? 26 : (side_ - 13 + 2 * gaps - 1) / (2 * gaps) * 2;
    for (int k = 0; k <= gaps; ++k) {
      const int middle = k == 0 ? 6 : side_ - 7 - (gaps - k) * step;
      if (middle - 2 <= place && place <= middle + 2) return k;
    }
    return -1;
  }
  /// Tells whether a module belongs to a pattern, the format or the version, and therefore holds no data.
  [[nodiscard]] bool fixed(int x, int y) const {
    const int far = side_ - 8;
    if ((x < 9 && (y < 9 || y >= far)) || (x >= far && y < 9) || x == 6 || y == 6) return true;
    if (version_ >= 7 && ((x < 6 && y >= far - 3) || (y < 6 && x >= far - 3))) return true;
    if (version_ == 1) return false;
    const int column = alignment(x), row = alignment(y), last = version_ / 7 + 1;
    return column >= 0 && row >= 0 && !(column == 0 && row == last) && !(column == last && row == 0);
  }
  /// Marks each codeword, in the order of their places, that has a wrong module.
  [[nodiscard]] std::vector<char> wrongWords() const {
    std::vector<char> words;
    int bit = 0;
    bool up = true;
    for (int right = side_ - 1; right > 0; right -= 2, up = !up) {
      if (right == 6) --right;  // skips the timing pattern
      for (int k = 0; k < 2 * side_; ++k) {
        const int x = right - k % 2, y = up ? side_ - 1 - k / 2 : k / 2;
        if (fixed(x, y)) continue;
        if (bit % 8 == 0) words.push_back(0);
        if (wrong(x, y)) words.back() = 1;
        ++bit;
      }
    }
    if (bit % 8 != 0) words.pop_back();  // the remaining bits hold nothing
    return words;
  }
  /// Tells whether each block has few enough wrong words to be corrected.
  [[nodiscard]] bool blocksRead() const {
    // The level is two bits of the format: low 1, medium 0, quartile 3, high 2; the mask inverts the upper one.
    const std::size_t level = ((dark(0, 8) ^ 1) * 2 + dark(1, 8)) ^ 1;
    const std::size_t version = version_ - 1;
    const std::size_t blocks = kBlocks[level][version], correction = kCorrectionWords[level][version];
    const std::vector<char> words = wrongWords();
    const std::size_t data = words.size() - blocks * correction, shared = data - data % blocks;
    std::vector<std::size_t> count(blocks);
    for (std::size_t k = 0; k < words.size(); ++k) {
      // The last blocks have one more data word than the others.
      const std::size_t block = k < shared ? k % blocks : k < data ? blocks - data + k : (k - data) % blocks;
      if (words[k] != 0 && ++count[block] > correction / 2) return false;
    }
    return true;
  }

  const Image& code_;
  const std::vector<char>& wrong_;
  int side_;
  int version_;
};

}  // namespace

bool qrReads(const Image& code, const std::vector<char>& wrong) { return CodeReading(code, wrong).succeeds(); }

}  // namespace sillon
