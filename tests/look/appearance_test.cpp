#include "sillon/look/appearance.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "look/inversion_parts.hpp"
#include "look/rasters.hpp"
#include "sillon/look/inversion.hpp"

using namespace sillon;

namespace {

constexpr Roughness kBlue{2.36, 17.32};

Vec2f unit(double degrees) {
  return {static_cast<float>(std::cos(degrees * std::numbers::pi / 180)),
          static_cast<float>(std::sin(degrees * std::numbers::pi / 180))};
}

/// The model again, with the mean over the bead's width in closed form: a difference of error functions.
double exactHighlight(const Lamp& lamp, const Roughness& roughness, double degrees) {
  const double azimuth = lamp.azimuth * std::numbers::pi / 180, elevation = lamp.elevation * std::numbers::pi / 180,
               angle = degrees * std::numbers::pi / 180;
  const double size = std::cos(elevation) / (1 + std::sin(elevation));
  const double along = size * std::cos(azimuth - angle), across = size * std::sin(azimuth - angle);
  const auto variance = [&](double slope) {
    return std::pow(std::tan(slope * std::numbers::pi / 180), 2) + lamp.slope * lamp.slope;
  };
  const double va = variance(roughness.along), vc = variance(roughness.across), root = std::sqrt(2 * vc), top = 0.3;
  const double mean = std::sqrt(std::numbers::pi / 4) * root / (2 * top) *
                      (std::erf((across + top) / root) - std::erf((across - top) / root));
  return std::exp(-along * along / (2 * va)) * mean;
}

/// Width of the lobe at half of its height between the brightest and the darkest direction [degrees].
double halfWidth(const Lamp& lamp, const Roughness& roughness) {
  const std::vector<float> table = lightTable(lobeOf(lamp, roughness), 1800);
  int above = 0;
  for (const float light : table) above += light > 0.5f * (1 + 0.05f) ? 1 : 0;
  return above * 0.1;
}

}  // namespace

TEST_CASE("the lobe is the one of the formula, the mean over the bead's width included") {
  for (const double slope : {0.02, 0.1, 0.4}) {
    for (const double elevation : {20.0, 45.0, 70.0}) {
      for (const Roughness& roughness : {kBlue, Roughness{8.93, 15.6}, Roughness{0.88, 11.63}}) {
        const Lamp lamp{37, elevation, slope};
        const Lobe lobe = lobeOf(lamp, roughness);
        for (int degrees = 0; degrees < 180; degrees += 3) {
          const auto found = static_cast<double>(highlightOf(lobe, unit(degrees)));
          CHECK(found == doctest::Approx(exactHighlight(lamp, roughness, degrees)).epsilon(0.02).scale(0.1));
        }
      }
    }
  }
}

TEST_CASE("beads across the lamp are brightest, beads along it darkest, and either end of a bead is the same") {
  const Lobe lobe = lobeOf({25, 45, 0.1}, kBlue);
  CHECK(lightOf(lobe, unit(115)) == doctest::Approx(1).epsilon(1e-3));
  CHECK(lightOf(lobe, unit(25)) < 0.06f);
  float before = 2;
  for (int off = 0; off <= 90; ++off) {  // monotone on either side
    const float light = lightOf(lobe, unit(115 + off));
    CHECK(light <= before);
    CHECK(light == doctest::Approx(lightOf(lobe, unit(115 - off))).epsilon(1e-4));
    CHECK(light == doctest::Approx(lightOf(lobe, unit(295 + off))).epsilon(1e-4));
    before = light;
  }
  CHECK(contrastOf(lobe) > 15);
}

TEST_CASE("a lamp straight above tells no directions apart") { CHECK(contrastOf(lobeOf({0, 90, 0.1}, kBlue)) < 1.001); }

TEST_CASE("the larger the lamp, the wider the lobe; numbers of Tab. 1 are degrees") {
  const double bulb = halfWidth({60, 45, bulbSlope()}, kBlue), softbox = halfWidth({60, 45, softboxSlope()}, kBlue);
  CHECK(bulb > 13);
  CHECK(bulb < 19);
  CHECK(softbox > 36);
  CHECK(softbox < 47);
  CHECK(contrastOf(lobeOf({60, 45, windowSlope()}, kBlue)) < contrastOf(lobeOf({60, 45, 0.1}, kBlue)) / 4);
  CHECK(lobeOf({60, 45, 0}, {45, 10}).alongVariance == doctest::Approx(1));  // tan 45 degrees
}

TEST_CASE("lamps and slopes out of range are named") {
  CHECK_FALSE(invalidLamp({}));
  CHECK(invalidLamp({0, 0.5, 0.1})->message.find("elevation") != std::string::npos);
  CHECK(invalidLamp({std::numeric_limits<double>::quiet_NaN(), 45, 0.1})->message.find("azimuth") != std::string::npos);
  CHECK(invalidLamp({0, 45, -0.1})->message.find("size") != std::string::npos);
  CHECK_FALSE(invalidRoughness(kBlue));
  CHECK(invalidRoughness({0, 10})->message.find("0.1 to 45") != std::string::npos);
}

TEST_CASE("highlights decay as e^-x") {
  for (double x = 0; x < 60; x += 0.37) {
    CHECK(static_cast<double>(decay(static_cast<float>(x))) / std::exp(-x) == doctest::Approx(1).epsilon(5e-5));
  }
  CHECK(decay(1e30f) >= 0);
  CHECK(decay(1e30f) < 1e-30f);
}

TEST_CASE("sRGB codes and light are each other's inverse") {
  for (int k = 0; k <= 255; ++k) {
    const double code = k / 255.0;
    const double light = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    CHECK(static_cast<double>(lightOfCode(static_cast<float>(code))) == doctest::Approx(light).scale(1).epsilon(1e-6));
    CHECK(static_cast<double>(codeOfLight(static_cast<float>(light))) == doctest::Approx(code).scale(1).epsilon(2e-5));
  }
}

TEST_CASE("pictures become luminance, are averaged as light, and levelled at their percentiles") {
  const Image green{1, 1, 4, {0, 65535, 0, 65535}};
  CHECK(tonesOf(green).value[0] == doctest::Approx(codeOfLight(0.7152f)).epsilon(1e-4));
  // What is transparent shows white paper.
  CHECK(tonesOf({1, 1, 2, {0, 0}}).value[0] == 1);
  CHECK(tonesOf({1, 1, 2, {0, 65535}}).value[0] == 0);
  CHECK(tonesOf({1, 1, 4, {0, 0, 0, 16384}}).value[0] == doctest::Approx(0.75).epsilon(1e-3));

  const Tones chess{2, 2, {0, 1, 1, 0}};
  CHECK(resampled(chess, 1, 1).value[0] == doctest::Approx(codeOfLight(0.5f)).epsilon(1e-4));
  CHECK(resampled(resampled(chess, 8, 8), 2, 2).at(1, 0) > 0.85f);

  Tones ramp{100, 1, {}};
  for (int k = 0; k < 100; ++k) ramp.value.push_back(0.4f + 0.001f * static_cast<float>(k));
  const Tones levels = levelled(ramp);
  CHECK(levels.value[0] == 0);
  CHECK(levels.value[99] == 1);
  CHECK(levels.value[50] == doctest::Approx(0.5).epsilon(0.03));
  CHECK(levelled({2, 2, {0.3f, 0.3f, 0.3f, 0.3f}}).value[3] == 0.5f);
  // Rounding is no picture; one step of 8 bits is.
  CHECK(levelled({2, 2, {0.3f, 0.3000001f, 0.3f, 0.3f}}).value == std::vector<float>(4, 0.5f));
  CHECK(levelled({2, 2, {0.3f, 0.304f, 0.3f, 0.3f}}).value == std::vector<float>{0, 1, 0, 0});
  Tones logo{200, 1, std::vector<float>(200, 0.2f)};
  logo.value[7] = 0.9f;  // fewer than a hundredth: still a picture of two tones
  CHECK(levelled(logo).value[7] == 1);
  CHECK(levelled(logo).value[8] == 0);
}

TEST_CASE("spools are those of Tab. 1, with slopes between the nozzles measured") {
  CHECK(spools().size() == 5);
  std::set<std::string> keys;
  for (const Spool& spool : spools()) {
    keys.insert(spool.key);
    for (const double nozzle : {0.25, 0.4, 0.6, 0.8, 1.2}) {
      for (const bool bed : {false, true}) {
        const Roughness r = roughnessOf(spool, nozzle, bed);
        CHECK_FALSE(invalidRoughness(r));
        CHECK(r.across > r.along);
      }
    }
  }
  CHECK(keys.size() == 5);
  CHECK(findSpool("nylon") == nullptr);
  REQUIRE(findSpool("bluePla") != nullptr);
  const Spool& blue = *findSpool("bluePla");
  CHECK(roughnessOf(blue, 0.4, false) == Roughness{2.36, 17.32});
  CHECK(roughnessOf(blue, 0.25, true) == Roughness{2.56, 13.54});
  CHECK(roughnessOf(blue, 0.6, false).across == doctest::Approx((17.32 + 17.69) / 2));
  CHECK(roughnessOf(blue, 2, true) == Roughness{2.43, 20.9});
}
