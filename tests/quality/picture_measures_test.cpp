#include "sillon/quality/metrics.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "look/rasters.hpp"
#include "quality/seen_cells.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "support/measure_pictures.hpp"

using namespace sillon;

namespace {

constexpr Roughness kBlue{2.36, 17.32};

/// Straight beads over a page of 20 x 20 mm: left half along +x, right half along +y.
Toolpath twoHalves() {
  Toolpath toolpath{{}, 0.5};
  for (double at = 0.25; at < 20; at += 1) {
    const auto p = static_cast<float>(at), q = static_cast<float>(at + 0.5);
    toolpath.cycles.push_back({{{0, p}, {10, p}, {10, q}, {0, q}}, {0.5f, 0.5f, 0.5f, 0.5f}});
    if (at < 10) {
      const auto x = static_cast<float>(10 + at), y = static_cast<float>(10.5 + at);
      toolpath.cycles.push_back({{{x, 0}, {x, 20}, {y, 20}, {y, 0}}, {0.5f, 0.5f, 0.5f, 0.5f}});
    }
  }
  return toolpath;
}

Tones halves(float left, float right) {
  Tones tones{20, 20, {}};
  for (int k = 0; k < 400; ++k) tones.value.push_back(k % 20 < 10 ? left : right);
  return tones;
}

Tones portrait(int side) {
  Tones tones{side, side, {}};
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double x = (i + 0.5) / side * 2 - 1, y = 1 - (j + 0.5) / side * 2;
      const double z2 = 0.6 - x * x - y * y;
      double tone = z2 > 0 ? (0.35 * x + 0.5 * y + 0.8 * std::sqrt(z2)) / 0.9 : 0.25 + 0.2 * y;
      if ((x - 0.25) * (x - 0.25) + (y - 0.2) * (y - 0.2) < 0.012) tone = 0.05;
      if ((x + 0.25) * (x + 0.25) + (y - 0.2) * (y - 0.2) < 0.012) tone = 0.05;
      tones.value.push_back(static_cast<float>(std::clamp(tone, 0.0, 1.0)));
    }
  }
  return tones;
}

/// Light of the beads as solids: round tops whose surface is rough, lit by a lamp of some size. Each point of the top,
/// tau/16 apart, has the slope of its height across the bead plus a random one; it sends light if that slope mirrors
/// some point of the lamp into the eye. No formula of the lobe is used. \return light of cells of 2 tau.
std::vector<float> renderedShapes(const Toolpath& toolpath, double page, int cells, const Lamp& lamp) {
  constexpr int kPoints = 32;  // per cell and axis: tau/16
  constexpr int kTrials = 24;
  const int side = cells * kPoints;
  const double perMm = side / page;
  std::vector<float> offset(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 1e9f);
  std::vector<Vec2f> along(offset.size());
  for (const Cycle& cycle : toolpath.cycles) {
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      const std::size_t next = (k + 1) % cycle.points.size();
      const Vec2f a = cycle.points[k], d = cycle.points[next] - a;
      const float size = length(d);
      if (!(size > 0)) continue;
      const Vec2f t = d * (1 / size);
      const float radius = std::max(cycle.widths[k], cycle.widths[next]) / 2;
      const auto from = [&](float p, float q) {
        return std::max(0, static_cast<int>((std::min(p, q) - radius) * static_cast<float>(perMm)));
      };
      const auto to = [&](float p, float q) {
        return std::min(side - 1, static_cast<int>((std::max(p, q) + radius) * static_cast<float>(perMm)) + 1);
      };
      for (int y = from(a.y, a.y + d.y); y <= to(a.y, a.y + d.y); ++y) {
        for (int x = from(a.x, a.x + d.x); x <= to(a.x, a.x + d.x); ++x) {
          const Vec2f p{static_cast<float>((x + 0.5) / perMm) - a.x, static_cast<float>((y + 0.5) / perMm) - a.y};
          const float s = dot(p, t);
          if (s < 0 || s > size) continue;
          const float across = cross(t, p) / radius;  // -1..1, positive to the left
          const std::size_t at =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
          if (std::abs(across) < 1 && std::abs(across) < std::abs(offset[at])) {
            offset[at] = across;
            along[at] = t;
          }
        }
      }
    }
  }
  std::uint64_t state = 1;
  const auto uniform = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  };
  const auto gauss = [&] {  // Irwin-Hall: twelve of them less six
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += uniform();
    return sum;
  };
  const double pi = 3.14159265358979;
  const double azimuth = lamp.azimuth * pi / 180, elevation = lamp.elevation * pi / 180;
  const double tilt = std::cos(elevation) / (1 + std::sin(elevation));
  const double slopeAlong = std::tan(kBlue.along * pi / 180), slopeAcross = std::tan(kBlue.across * pi / 180);
  std::vector<float> light;
  for (int cy = cells; cy-- > 0;) {  // row 0 on top
    for (int cx = 0; cx < cells; ++cx) {
      int lit = 0, seen = 0;
      for (int k = 0; k < kPoints * kPoints; k += 3) {
        const std::size_t at = static_cast<std::size_t>(cy * kPoints + k / kPoints) * static_cast<std::size_t>(side) +
                               static_cast<std::size_t>(cx * kPoints + k % kPoints);
        if (offset[at] > 1) continue;
        const double tx = static_cast<double>(along[at].x), ty = static_cast<double>(along[at].y);
        for (int trial = 0; trial < kTrials; ++trial) {
          // A top that is a parabola: its slope grows evenly towards the edges, falling off to either side.
          const double a = slopeAlong * gauss(), c = slopeAcross * gauss() + 0.3 * static_cast<double>(offset[at]);
          const double mx = a * tx - c * ty, my = a * ty + c * tx;
          const double dx = mx - tilt * std::cos(azimuth), dy = my - tilt * std::sin(azimuth);
          lit += dx * dx + dy * dy < 2 * lamp.slope * lamp.slope ? 1 : 0;  // a round lamp as large as the Gaussian one
          ++seen;
        }
      }
      light.push_back(seen > 0 ? 0.02f + static_cast<float>(lit) / static_cast<float>(seen) : -1.0f);
    }
  }
  return light;
}

}  // namespace

TEST_CASE("two halves of beads are bright and dark as the lamp has them") {
  const ShownPicture bright{"a", {90, 45, 0.1}, halves(1, 0)}, dark{"b", {0, 45, 0.1}, halves(0, 1)};
  const auto measured = measurePictures(twoHalves(), {20, 20}, std::vector{bright, dark}, kBlue, RunContext(1));
  REQUIRE(measured.ok());
  REQUIRE(measured.value().size() == 2);
  for (const PictureMeasures& m : measured.value()) {
    CHECK(m.r > 0.97);
    CHECK(m.ssim > 0.75);  // turns along the middle
    CHECK(m.contrast > 12);
  }
  CHECK(measured.value()[0].others[0] == doctest::Approx(measured.value()[0].r));
  CHECK(measured.value()[0].others[1] < -0.97);  // the other picture is this one's negative
}

TEST_CASE(
    "a picture compared with itself is perfect, with its negative the opposite, and flat light has no correlation") {
  const Tones tones = portrait(40);
  std::vector<float> light, negative;
  for (const float v : tones.value) {
    light.push_back(lightOfCode(v));
    negative.push_back(lightOfCode(1 - v));
  }
  const PictureMeasures same = compareTones(light, tones);
  CHECK(same.r == doctest::Approx(1).epsilon(1e-4));
  CHECK(same.ssim == doctest::Approx(1).epsilon(1e-3));
  CHECK(compareTones(negative, tones).r == doctest::Approx(-1).epsilon(1e-4));
  const PictureMeasures flat = compareTones(std::vector<float>(1600, 0.3f), tones);
  CHECK(flat.r == 0);
  CHECK(flat.contrast == doctest::Approx(1));
  CHECK(compareTones(std::vector<float>(1600, -1.0f), tones).r == 0);  // no plate at all
  CHECK(compareTones({}, tones).r == 0);                               // other sizes
  CHECK(compareTones(std::vector<float>(1601, 0.3f), tones).contrast == 1);
  Tones lacking = tones;
  lacking.value.pop_back();
  CHECK(compareTones(light, lacking).r == 0);
  // An affine change of what is seen is the exposure's, and does not count.
  std::vector<float> dimmer;
  for (const float v : tones.value) dimmer.push_back(lightOfCode(0.2f + 0.5f * v));
  CHECK(compareTones(dimmer, tones).ssim > 0.998);
}

TEST_CASE("figures do not depend on threads; defects and cancelling are told") {
  const ShownPicture picture{"a", {90, 45, 0.1}, halves(1, 0)};
  const auto one = measurePictures(twoHalves(), {20, 20}, std::vector{picture}, kBlue, RunContext(1));
  const auto four = measurePictures(twoHalves(), {20, 20}, std::vector{picture}, kBlue, RunContext(4));
  CHECK(one.value()[0].r == four.value()[0].r);
  CHECK(one.value()[0].ssim == four.value()[0].ssim);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(!measurePictures(twoHalves(), {20, nan}, std::vector{picture}, kBlue, RunContext(1)).ok());
  Toolpath fine = twoHalves();
  fine.spacing = 0.001;
  CHECK(measurePictures(fine, {20, 20}, std::vector{picture}, kBlue, RunContext(1)).error().code ==
        ErrorCode::TooLarge);
  RunContext stopped(1);
  stopped.requestCancel();
  CHECK(measurePictures(twoHalves(), {20, 20}, std::vector{picture}, kBlue, stopped).error().code ==
        ErrorCode::Cancelled);
}

TEST_CASE("beads rendered as rough round solids agree with the formula: the inverse is the better picture") {
  constexpr double kPage = 32, kSpacing = 0.5;
  constexpr int kCells = 32;
  const RunContext run(2);
  const Lamp lamp{60, 45, 0.1};
  InversionParams params;
  const auto solved =
      solveDirections(std::vector<LitPicture>{{portrait(80), lamp}}, kBlue, {{kPage, kPage}, kSpacing}, params, run);
  REQUIRE(solved.ok());
  DirectionMap straight = solved.value().directions;
  for (std::size_t k = 0; k < straight.angle.size(); ++k) {
    const double turn = (60 + 90 * static_cast<double>(solved.value().shown[0].value[k])) / 180 + 0.5;
    straight.angle[k] = static_cast<std::uint16_t>((turn - std::floor(turn)) * 65535);
  }
  const Tones asked = resampled(solved.value().shown[0], kCells, kCells);
  struct Seen {
    double formula, shapes;
  };
  const auto seen = [&](const DirectionMap& directions) {
    ToolpathParams toolpath;
    toolpath.spacing = kSpacing;
    const auto plate = generateToolpath(
        {makeRectangle({kPage, kPage}).value(), directions, uniformMode(DirectionMode::Constrained)}, toolpath, run);
    REQUIRE(plate.ok());
    const ShownPicture picture{"", lamp, solved.value().shown[0]};
    const auto formula = measurePictures(plate.value().toolpath, {kPage, kPage}, std::vector{picture}, kBlue, run);
    REQUIRE(formula.ok());
    return Seen{formula.value()[0].r,
                compareTones(renderedShapes(plate.value().toolpath, kPage, kCells, lamp), asked).r};
  };
  const Seen inverse = seen(solved.value().directions), line = seen(straight);
  MESSAGE("inverse: formula " << inverse.formula << ", shapes " << inverse.shapes << "; straight line: formula "
                              << line.formula << ", shapes " << line.shapes);
  CHECK(inverse.formula > line.formula);
  CHECK(inverse.shapes > line.shapes);
  CHECK(std::abs(inverse.shapes - inverse.formula) < 0.06);
}
