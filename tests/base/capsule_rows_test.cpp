#include "base/capsule_rows.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace sillon;

namespace {

constexpr int kColumns = 61;
constexpr int kRows = 47;

std::vector<char> drawn(const Capsule& capsule) {
  std::vector<char> pixels(static_cast<std::size_t>(kColumns) * kRows, 0);
  const int rows = capsule.endRow(kRows);
  PixelRuns runs;
  for (int y = capsule.firstRow(kRows); y < rows; y += PixelRuns::kMostRows) {
    const int count = std::min(PixelRuns::kMostRows, rows - y);
    pixelsOf(capsule, y, count, kColumns, runs);
    for (int k = 0; k < count; ++k) {
      for (int x = runs.begin[k]; x < runs.end[k]; ++x) pixels[(y + k) * kColumns + x] = 1;
    }
  }
  return pixels;
}

// How far p lies outside of the union of discs: the least over them, by ternary search of a convex function.
double outside(Vec2 p, Vec2f a, Vec2f b, float ra, float rb) {
  const auto of = [&](double t) {
    const Vec2 centre{a.x + t * (static_cast<double>(b.x) - a.x), a.y + t * (static_cast<double>(b.y) - a.y)};
    return length(p - centre) - (ra + t * (static_cast<double>(rb) - ra));
  };
  double low = 0;
  double high = 1;
  for (int k = 0; k < 60; ++k) {
    const double third = (high - low) / 3;
    (of(low + third) < of(high - third) ? high : low) += of(low + third) < of(high - third) ? -third : third;
  }
  return of((low + high) / 2);
}

}  // namespace

TEST_CASE("the rows of a capsule hold the pixels whose centres lie in one of its discs, and no others") {
  std::mt19937 random(5);
  const auto within = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() % 10001) / 10000.0f;
  };
  int inside = 0;
  int wrong = 0;
  for (int round = 0; round < 400; ++round) {
    const Vec2f a{within(-10, 70), within(-10, 60)};
    Vec2f b{within(-10, 70), within(-10, 60)};
    if (round % 5 == 0) b = a + Vec2f{within(-8, 8), within(-8, 8)};
    if (round % 7 == 0) b.y = a.y;
    if (round % 11 == 0) b.x = a.x;
    if (round % 13 == 0) b = a;
    const float ra = within(0, 12);
    const float rb = round % 3 == 0 ? ra : within(0, 12);
    const std::vector<char> pixels = drawn(Capsule(a, b, ra, rb));
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const double off = outside({static_cast<double>(x), static_cast<double>(y)}, a, b, ra, rb);
        const bool is = pixels[y * kColumns + x] != 0;
        inside += is ? 1 : 0;
        wrong += std::abs(off) > 1e-3 && is != (off < 0) ? 1 : 0;
      }
    }
  }
  CHECK(inside > 50000);
  CHECK(wrong == 0);
}

TEST_CASE("a capsule beside the raster, or further away than numbers reach, has no pixels on it") {
  const auto count = [](const Capsule& capsule) {
    int sum = 0;
    for (const char pixel : drawn(capsule)) sum += pixel;
    return sum;
  };
  CHECK(count(Capsule({-30, 5}, {-20, 40}, 9, 5)) == 0);
  CHECK(count(Capsule({80, 5}, {90, 40}, 9, 5)) == 0);
  CHECK(count(Capsule({5, -30}, {40, -20}, 9, 5)) == 0);
  CHECK(count(Capsule({5, 80}, {40, 90}, 9, 5)) == 0);
  CHECK(count(Capsule({3e38f, 1e38f}, {-3e38f, 2e38f}, 1, 1)) == 0);
  CHECK(count(Capsule({20, 20}, {30, 20}, 1e6f, 1e6f)) == kColumns * kRows);
}
