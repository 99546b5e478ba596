#include "sillon/look/inversion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace sillon;

namespace {

constexpr Roughness kBlue{2.36, 17.32};
constexpr int kSide = 40;

template <class Tone>
Tones drawn(Tone tone) {
  Tones tones{kSide, kSide, {}};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) tones.value.push_back(tone(x, y));
  }
  return tones;
}

struct Solved {
  std::vector<ShownPicture> shown;
  SolvedDirections directions;
};

Solved solved(const std::vector<Tones>& pictures, double level) {
  std::vector<LitPicture> lit;
  for (const Tones& tones : pictures) lit.push_back({tones, {60, 45, 0.1}, false});
  InversionParams params;
  params.level = level;
  params.smoothness = 0.001;
  params.sharpness = 0;
  auto result = solveDirections(lit, kBlue, {{8, 8}, 0.4}, params, RunContext(1));
  REQUIRE(result.ok());
  Solved out;
  out.directions = std::move(result).value();
  for (std::size_t k = 0; k < lit.size(); ++k) out.shown.push_back({"", lit[k].lamp, out.directions.shown[k]});
  return out;
}

PictureConflict conflictOf(const Solved& s) {
  return conflictOf(s.directions.directions, s.shown, kBlue, s.directions.level);
}

float most(const std::vector<float>& missing) {
  float out = 0;
  for (const float v : missing) out = std::max(out, std::abs(v));
  return out;
}

}  // namespace

TEST_CASE("equal pictures under one lamp take nothing from each other") {
  const Tones ramp = drawn([](int x, int) { return static_cast<float>(x) / (kSide - 1); });
  const PictureConflict conflict = conflictOf(solved({ramp, ramp}, 1));
  CHECK(conflict.width == kSide);
  CHECK(conflict.height == kSide);
  REQUIRE(conflict.missing.size() == 2);
  for (const std::vector<float>& missing : conflict.missing) CHECK(most(missing) < 0.04f);
}

TEST_CASE("black against white under one lamp leaves both half way, whatever the level of white") {
  const auto board = [](int x, int y) { return static_cast<float>((x / 20 + y / 20) % 2); };
  const Tones black = drawn(board), white = drawn([&](int x, int y) { return 1 - board(x, y); });
  for (const double level : {1.0, 0.5}) {
    const PictureConflict conflict = conflictOf(solved({black, white}, level));
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const auto cell = static_cast<std::size_t>(y * kSide + x);
        const float sign = board(x, y) > 0.5f ? 1.0f : -1.0f;  // light is missing where white is asked for
        CHECK(conflict.missing[0][cell] == doctest::Approx(0.5f * sign).epsilon(0.08));
        CHECK(conflict.missing[1][cell] == doctest::Approx(-0.5f * sign).epsilon(0.08));
      }
    }
  }
}

TEST_CASE("what a direction shows is read at its angle, and what misses by more than the whole way is cut off") {
  // Black asked for, and directions across the lamp, the brightest ones.
  const Lamp lamp{30, 45, 0.1};
  DirectionMap across{1, 1, {static_cast<std::uint16_t>((120 + 90 - 180) / 180.0 * 65535)}};
  const std::vector<ShownPicture> black{{"", lamp, Tones{1, 1, {0}}}}, white{{"", lamp, Tones{1, 1, {1}}}};
  CHECK(conflictOf(across, black, kBlue, 1).missing[0][0] == doctest::Approx(-1).epsilon(1e-3));
  CHECK(conflictOf(across, white, kBlue, 1).missing[0][0] == doctest::Approx(0).epsilon(1e-3));
  CHECK(conflictOf(across, black, kBlue, 0.2).missing[0][0] == -1.0f);
  DirectionMap along{1, 1, {static_cast<std::uint16_t>((30 + 90) / 180.0 * 65535)}};
  CHECK(conflictOf(along, white, kBlue, 1).missing[0][0] == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("drawn, cells without conflict are pale greys, too dark ones orange and too bright ones blue") {
  const PictureConflict conflict{3, 1, {{0, 1, -1}}};
  const RgbImage image = conflictImage(conflict, 0, Tones{3, 1, {1, 1, 0}}, 12);
  CHECK(image.width == 12);
  CHECK(image.height == 4);
  REQUIRE(image.rgb.size() == 3 * 12 * 4);
  const auto at = [&](int x) { return &image.rgb[3 * x]; };
  CHECK(at(0)[0] == at(0)[1]);
  CHECK(at(0)[1] == at(0)[2]);
  CHECK(at(0)[0] > 230);
  CHECK(at(4)[0] > at(4)[2] + 100);
  CHECK(at(8)[2] > at(8)[0] + 100);
}
