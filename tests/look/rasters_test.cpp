// Means and blurs of rasters, in closed forms.
#include "look/rasters.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sillon;

TEST_CASE("a blur spreads a point as widely as its sigma says, and keeps its sum") {
  constexpr int kSide = 201, kMiddle = kSide / 2;
  for (const float sigma : {0.5F, 1.0F, 3.0F, 10.0F}) {
    CAPTURE(sigma);
    std::vector<float> point(static_cast<std::size_t>(kSide) * kSide);
    point[static_cast<std::size_t>(kMiddle) * kSide + kMiddle] = 1;
    const std::vector<float> soft = blurred(point, kSide, kSide, sigma);
    double sum = 0, across = 0, down = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double value = soft[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)];
        sum += value;
        across += value * (x - kMiddle) * (x - kMiddle);
        down += value * (y - kMiddle) * (y - kMiddle);
      }
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-3));
    CHECK(std::sqrt(across) == doctest::Approx(sigma).epsilon(0.01));
    CHECK(std::sqrt(down) == doctest::Approx(sigma).epsilon(0.01));
  }
}

TEST_CASE("an even raster stays as it is, also at its borders") {
  for (const float value : blurred(std::vector<float>(12 * 5, 0.25F), 12, 5, 40)) CHECK(value == 0.25F);
}

TEST_CASE("means are of the values themselves, over what a cell covers") {
  const Tones given{4, 2, {0, 1, 0.5F, 0.5F, 1, 0, -3, 4}};
  CHECK(means(given, 4, 2) == given);
  CHECK(means(given, 2, 1).value == std::vector<float>{0.5F, 0.5F});
  CHECK(means(given, 1, 2).value == std::vector<float>{0.5F, 0.5F});
  const Tones finer = means({2, 1, {0, 1}}, 4, 1);
  CHECK(finer.value == std::vector<float>{0, 0.25F, 0.75F, 1});
}
