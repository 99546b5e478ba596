#include "geometry/signed_distance.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "support/scenes.hpp"

using namespace sillon;

TEST_CASE("from one wall the way goes slant as far as it can, in every direction") {
  constexpr int kColumns = 9, kRows = 7;
  for (const auto& [x, y] : {std::pair{4, 3}, {0, 0}, {8, 0}, {0, 6}, {8, 6}, {2, 5}}) {
    std::vector<char> wall(kColumns * kRows, 0);
    wall[y * kColumns + x] = 1;
    const std::vector<float> far = chamferDistance(wall, kColumns, kRows);
    for (int k = 0; k < kColumns * kRows; ++k) {
      const int dx = std::abs(k % kColumns - x), dy = std::abs(k / kColumns - y);
      const double slant = std::min(dx, dy), straight = std::max(dx, dy) - slant;
      CHECK(std::abs(static_cast<double>(far[k]) - (slant * std::sqrt(2.0) + straight)) < 1e-5);
    }
  }
}

TEST_CASE("of many walls the nearest counts, within 8 % of the true distance") {
  constexpr int kColumns = 40, kRows = 30;
  scenes::Random random(3);
  std::vector<char> wall(kColumns * kRows, 0);
  for (int k = 0; k < 12; ++k) wall[random.index(kColumns * kRows)] = 1;
  const std::vector<float> far = chamferDistance(wall, kColumns, kRows);
  for (int k = 0; k < kColumns * kRows; ++k) {
    double nearest = 1e9;
    for (int w = 0; w < kColumns * kRows; ++w) {
      if (wall[w] == 0) continue;
      nearest = std::min(nearest, std::hypot(w % kColumns - k % kColumns, w / kColumns - k / kColumns));
    }
    CHECK(far[k] >= nearest - 1e-4);
    CHECK(far[k] <= 1.0824 * nearest + 1e-4);
  }
  for (const float none : chamferDistance(std::vector<char>(6, 0), 3, 2)) CHECK(none == 1e9f);
}
