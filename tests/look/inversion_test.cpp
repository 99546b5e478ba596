#include "sillon/look/inversion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "quality/seen_cells.hpp"
#include "sillon/quality/metrics.hpp"

using namespace sillon;

namespace {

constexpr Roughness kBlue{2.36, 17.32};
constexpr double kSpacing = 0.4;

template <class Tone>
Tones drawn(int side, Tone tone) {
  Tones tones{side, side, {}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      tones.value.push_back(static_cast<float>(tone((x + 0.5) / side * 2 - 1, 1 - (y + 0.5) / side * 2)));
    }
  }
  return tones;
}

Tones ramp() {
  return drawn(100, [](double x, double) { return (x + 1) / 2; });
}
Tones ball() {
  return drawn(100, [](double x, double y) {
    const double z2 = 0.64 - x * x - y * y;
    return z2 > 0 ? std::clamp((0.4 * x + 0.5 * y + 0.7 * std::sqrt(z2)) / 0.9, 0.1, 1.0) : 0.05;
  });
}
Tones disc(double cx, double cy, double radius) {
  return drawn(100,
               [=](double x, double y) { return (x - cx) * (x - cx) + (y - cy) * (y - cy) < radius * radius ? 1 : 0; });
}

/// Degrees from a texel's stored angle.
double degreesAt(const DirectionMap& map, int x, int y) {
  return (map.angle[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)] /
              65535.0 -
          0.5) *
         180;
}

/// What the directions alone show under a lamp, cell by cell.
std::vector<float> lightOf(const DirectionMap& map, const Lamp& lamp) {
  const std::vector<float> table = lightTable(lobeOf(lamp, kBlue), 3600);
  std::vector<float> light;
  for (const std::uint16_t angle : map.angle) {
    const double turn = angle / 65535.0 + 0.5;
    light.push_back(table[static_cast<std::size_t>((turn - std::floor(turn)) * 3600) % 3600]);
  }
  return light;
}

/// Sum of |divergence| of the beads' direction: what forces them to end.
double divergence(const DirectionMap& map) {
  double sum = 0;
  const auto step = [](double degrees) { return degrees - 180 * std::floor(degrees / 180 + 0.5); };
  for (int y = 1; y < map.height; ++y) {
    for (int x = 0; x + 1 < map.width; ++x) {
      const double angle = degreesAt(map, x, y), radians = angle * 3.14159265358979 / 180;
      sum += std::abs(std::cos(radians) * step(degreesAt(map, x, y - 1) - angle) -
                      std::sin(radians) * step(degreesAt(map, x + 1, y) - angle));
    }
  }
  return sum;
}

SolvedDirections solved(std::vector<LitPicture> pictures, InversionParams params = {}, int threads = 1) {
  auto result = solveDirections(pictures, kBlue, {{20, 20}, kSpacing}, params, RunContext(threads));
  REQUIRE(result.ok());
  return std::move(result).value();
}

std::string refused(std::vector<LitPicture> pictures, InversionParams params = {}, Vec2 page = {20, 20}) {
  const auto result = solveDirections(pictures, kBlue, {page, kSpacing}, params, RunContext(1));
  REQUIRE(!result.ok());
  CHECK(result.error().code == ErrorCode::InvalidArgument);
  return result.error().message;
}

}  // namespace

TEST_CASE("black lies along the lamp, white across it, and every tone between is shown as asked") {
  for (const double azimuth : {0.0, 60.0, 145.0}) {
    InversionParams params;
    params.sharpness = 0;
    params.smoothness = 0.005;
    const Lamp lamp{azimuth, 45, 0.1};
    const SolvedDirections out = solved({{ramp(), lamp}}, params);
    CHECK(out.directions.width == 100);
    const auto off = [&](int x) {
      const double turned = degreesAt(out.directions, x, 50) - azimuth;
      return std::abs(turned - 180 * std::floor(turned / 180 + 0.5));  // 0: along the lamp, 90: across it
    };
    CHECK(off(1) < 35);  // where the lobe is flat
    CHECK(off(98) > 75);
    const PictureMeasures m = compareTones(lightOf(out.directions, lamp), out.shown[0]);
    CHECK(m.r > 0.999);
    CHECK(m.ssim > 0.98);
    CHECK(m.contrast > 14);
  }
}

TEST_CASE("the inverse beats the straight line from grey to angle") {
  const Lamp lamp{60, 45, 0.1};
  InversionParams params;
  params.smoothness = 0.05;
  const SolvedDirections out = solved({{ball(), lamp}}, params);
  DirectionMap line = out.directions;
  for (std::size_t k = 0; k < line.angle.size(); ++k) {
    const double turn = (60 + 90 * static_cast<double>(out.shown[0].value[k])) / 180 + 0.5;
    line.angle[k] = static_cast<std::uint16_t>((turn - std::floor(turn)) * 65535);
  }
  const PictureMeasures inverse = compareTones(lightOf(out.directions, lamp), out.shown[0]);
  const PictureMeasures straight = compareTones(lightOf(line, lamp), out.shown[0]);
  CHECK(inverse.r > 0.99);
  CHECK(inverse.r > straight.r + 0.02);
  CHECK(divergence(out.directions) < 0.92 * divergence(line));
}

TEST_CASE("more smoothness forces fewer beads to end") {
  InversionParams little, much;
  little.smoothness = 0.005;
  much.smoothness = 0.5;
  const Lamp lamp{60, 45, 0.1};
  CHECK(divergence(solved({{ball(), lamp}}, much).directions) <
        0.92 * divergence(solved({{ball(), lamp}}, little).directions));
}

TEST_CASE("two lamps that are not given stand where both pictures are seen better than 90 degrees apart") {
  const Tones first = ball(), second = ramp();
  const auto worstOf = [&](const SolvedDirections& out) {
    double worst = 1;
    for (std::size_t k = 0; k < 2; ++k) {
      worst = std::min(worst, compareTones(lightOf(out.directions, out.lamps[k]), out.shown[k]).r);
    }
    return worst;
  };
  const SolvedDirections chosen = solved({{first, {60, 45, 0.1}, true}, {second, {60, 45, 0.1}, true}});
  CHECK(chosen.lamps[0].azimuth == 60);
  CHECK(chosen.lamps[1].azimuth >= 85);
  CHECK(chosen.lamps[1].azimuth <= 110);
  // Where no direction is bright under both.
  CHECK(worstOf(chosen) > worstOf(solved({{first, {60, 45, 0.1}}, {second, {150, 45, 0.1}}})) + 0.05);
}

TEST_CASE("a lamp that is not given is one whose directions force fewer beads to end") {
  const Tones stripes = drawn(100, [](double x, double y) { return 0.5 + 0.5 * std::sin(9 * (x + 0.4 * y)); });
  const SolvedDirections chosen = solved({{stripes, {60, 45, 0.1}, true}});
  double worst = 0;
  for (int azimuth = 0; azimuth < 180; azimuth += 15) {
    const Lamp lamp{static_cast<double>(azimuth), 45, 0.1};
    worst = std::max(worst, divergence(solved({{stripes, lamp}}).directions));
  }
  CHECK(divergence(chosen.directions) < 0.95 * worst);
  CHECK(chosen.lamps[0].elevation == 45);
}

TEST_CASE("a smooth picture has no seam where both sides of the lamp meet") {
  const Tones sky = drawn(100, [](double x, double y) {
    return std::clamp(0.3 + 0.25 * y * y + 0.35 * std::exp(-3 * ((x - 0.3) * (x - 0.3) + (y - 0.1) * (y - 0.1))), 0.0,
                      1.0);
  });
  for (const double azimuth : {0.0, 30.0, 100.0, 150.0}) {
    CAPTURE(azimuth);
    const SolvedDirections out = solved({{sky, {azimuth, 45, 0.1}}});
    double steepest = 0;
    for (int y = 0; y < 100; ++y) {
      for (int x = 0; x + 1 < 100; ++x) {
        const double step = degreesAt(out.directions, x + 1, y) - degreesAt(out.directions, x, y);
        steepest = std::max(steepest, std::abs(step - 180 * std::floor(step / 180 + 0.5)));
      }
    }
    CHECK(steepest < 12);
  }
}

TEST_CASE("two pictures are each seen under their own lamp, and not under the other's") {
  const Tones left = disc(-0.3, 0, 0.5), right = disc(0.3, 0, 0.5);
  const Lamp lamp{60, 45, 0.1};
  const SolvedDirections out = solved({{left, lamp, true}, {right, lamp, true}});
  REQUIRE(out.lamps.size() == 2);
  const double apart = out.lamps[1].azimuth - out.lamps[0].azimuth;
  CHECK(apart >= 40);
  CHECK(apart <= 60);
  CHECK(out.level >= 0.25);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<float> light = lightOf(out.directions, out.lamps[k]);
    CHECK(compareTones(light, out.shown[k]).r > 0.97);
    CHECK(compareTones(light, out.shown[1 - k]).r < 0.5);
  }
}

TEST_CASE("three pictures have lamps 60 degrees apart unless they are given") {
  const Lamp lamp{10, 45, 0.1};
  const SolvedDirections out = solved(
      {{disc(-0.4, -0.4, 0.3), lamp, true}, {disc(0.4, -0.4, 0.3), lamp, true}, {disc(0, 0.5, 0.3), {80, 40, 0.05}}});
  CHECK(out.lamps[0].azimuth == 10);
  CHECK(out.lamps[1].azimuth == 70);
  CHECK(out.lamps[2] == Lamp{80, 40, 0.05});
}

TEST_CASE("the directions are the same for any number of threads") {
  const std::vector<LitPicture> pictures{{ball(), {60, 45, 0.1}, true}, {disc(0, 0, 0.6), {60, 45, 0.1}, true}};
  const SolvedDirections one = solved(pictures);
  CHECK(one.directions == solved(pictures, {}, 3).directions);
  CHECK(one.directions == solved(pictures, {}, 8).directions);
}

TEST_CASE("a picture of one tone, of one pixel or far larger than the plate is solved, too") {
  const Lamp lamp{60, 45, 0.1};
  CHECK(solved({{{1, 1, {0.5f}}, lamp}}).directions.width == 100);
  CHECK(solved({{drawn(700, [](double x, double) { return x > 0; }), lamp}}).directions.width == 100);
  const auto tiny =
      solveDirections(std::vector<LitPicture>{{ball(), lamp, true}}, kBlue, {{0.1, 0.1}, 1}, {}, RunContext(1));
  REQUIRE(tiny.ok());
  CHECK(tiny.value().directions.angle.size() == 1);
}

TEST_CASE("what cannot be solved is refused with the reason") {
  const Lamp lamp{60, 45, 0.1};
  CHECK(refused({}).find("1 to 4") != std::string::npos);
  CHECK(refused(std::vector<LitPicture>(5, {ball(), lamp})).find("pictures is 5") != std::string::npos);
  CHECK(refused({{ball(), {60, 90, 0.1}}}).find("lower") != std::string::npos);  // straight above: nothing to see
  CHECK(refused({{ball(), {60, 0, 0.1}}}).find("elevation") != std::string::npos);
  CHECK(refused({{{2, 2, {0}}, lamp}}).find("the map of tones is 2 x 2 pixels with 1 values") != std::string::npos);
  CHECK(refused({{ball(), lamp}}, {}, {20, std::numeric_limits<double>::quiet_NaN()}).find("page") !=
        std::string::npos);
  InversionParams params;
  params.smoothness = 0;
  CHECK(refused({{ball(), lamp}}, params).find("smoothness") != std::string::npos);
  params = {};
  params.level = 2;
  CHECK(refused({{ball(), lamp}}, params).find("level") != std::string::npos);

  RunContext stopped(1);
  stopped.requestCancel();
  CHECK(
      solveDirections(std::vector<LitPicture>{{ball(), lamp}}, kBlue, {{20, 20}, kSpacing}, {}, stopped).error().code ==
      ErrorCode::Cancelled);
}
