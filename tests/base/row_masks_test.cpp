#include "base/row_masks.hpp"

#include <doctest/doctest.h>

#include <random>
#include <vector>

using namespace sillon;

namespace {

constexpr int kRows = 31;

// Rows as pixels, of which each may be seen by itself.
using Pixels = std::vector<char>;

Pixels pixelsOf(const std::vector<RowMask>& rows) {
  Pixels pixels;
  for (const RowMask row : rows) {
    for (int x = 0; x < kRowPixels; ++x) pixels.push_back((row[x / 64] >> (x % 64) & 1) != 0 ? 1 : 0);
  }
  return pixels;
}

PixelRuns randomRuns(std::mt19937& random) {
  PixelRuns runs;
  for (int k = 0; k < PixelRuns::kMostRows; ++k) {
    runs.begin[k] = static_cast<std::int32_t>(random() % (kRowPixels + 1));
    runs.end[k] = static_cast<std::int32_t>(random() % (kRowPixels + 1));
  }
  return runs;
}

// With two rows at a time where that can be, and with one.
template <class Check>
void bothWays(const Check& check) {
  const bool eight = eightAtOnce;
  check();
  eightAtOnce = false;
  check();
  eightAtOnce = eight;
}

}  // namespace

TEST_CASE("runs are added to rows pixel by pixel, and to no row beyond their number") {
  bothWays([] {
    std::mt19937 random(3);
    for (int round = 0; round < 100; ++round) {
      std::vector<RowMask> rows(kRows, RowMask{});
      Pixels expected(kRows * kRowPixels, 0);
      for (int layer = 0; layer < 2; ++layer) {
        const PixelRuns runs = randomRuns(random);
        const int count = static_cast<int>(random() % (kRows / 2)) * 2;
        addRuns(runs, count, rows.data());
        for (int y = 0; y < count; ++y) {
          for (int x = runs.begin[y]; x < runs.end[y]; ++x) expected[static_cast<std::size_t>(y * kRowPixels + x)] = 1;
        }
      }
      CHECK(pixelsOf(rows) == expected);
    }
  });
}

TEST_CASE("rows are added, and meet where they share a pixel") {
  bothWays([] {
    std::mt19937 random(4);
    int met = 0;
    for (int round = 0; round < 400; ++round) {
      const int count = 2 * static_cast<int>(random() % 4);
      std::vector<RowMask> some(kRows, RowMask{}), others(kRows, RowMask{});
      for (int k = 0; k < 3; ++k) {
        const auto at = [&] { return static_cast<std::size_t>(random() % 6); };
        const int x = static_cast<int>(random() % 120);
        some[at()] = rowOf(x, x + 8);
        others[at()] = rowOf(x, x + 8);
      }
      const Pixels a = pixelsOf(some);
      const Pixels b = pixelsOf(others);
      bool expected = false;
      Pixels sum = b;
      for (std::size_t p = 0; p < static_cast<std::size_t>(count * kRowPixels); ++p) {
        expected = expected || (a[p] != 0 && b[p] != 0);
        sum[p] = a[p] != 0 || b[p] != 0 ? 1 : 0;
      }
      met += expected ? 1 : 0;
      CHECK(rowsMeet(some.data(), others.data(), count) == expected);
      addRows(some.data(), count, others.data());
      CHECK(pixelsOf(others) == sum);
    }
    CHECK(met > 20);
    CHECK(met < 380);
  });
}
