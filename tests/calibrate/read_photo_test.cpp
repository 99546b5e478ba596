// Photographs of coupons whose beads, lamp and camera are known, and pictures that are none.
#include "sillon/calibrate/read_photo.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sillon/look/spools.hpp"
#include "support/coupon_photo.hpp"

using namespace sillon;
using photo::good;
using photo::Truth;

namespace {

const CalibrationPlate& coupon() {
  static const CalibrationPlate plate = [] {
    const RunContext run(1);
    auto made = makeCalibration({CalibrationKind::Coupon, {}, {}, {}}, run);
    REQUIRE(made.ok());
    return std::move(made).value();
  }();
  return plate;
}

Image decoded(const std::vector<std::uint8_t>& bytes) {
  auto image = decodeImage(bytes, "photograph");
  REQUIRE(image.ok());
  return std::move(image).value();
}

/// The same, developed otherwise.
Image goodOne(const Truth& truth) {
  static const photo::Exposed film = photo::exposed(coupon(), good());
  return decoded(photo::developed(film, truth));
}

Result<CouponReading> readBack(const Truth& truth, const PhotoRequest& request = {}) {
  return readCouponPhoto(decoded(photo::taken(coupon(), truth)), request, RunContext(1));
}

std::string refused(const Image& image, const PhotoRequest& request = {}) {
  const auto read = readCouponPhoto(image, request, RunContext(1));
  return read ? "read" : read.error().message;
}
std::string refused(const Truth& truth, const PhotoRequest& request = {}) {
  return refused(decoded(photo::taken(coupon(), truth)), request);
}

Image picture(int width, int height, int channels, std::uint64_t seed, double noise) {
  scenes::Random random(seed);
  Image image{width, height, channels, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width * channels; ++x) {
      const double ramp = 0.5 + 0.4 * std::sin(0.01 * x) * std::cos(0.02 * y);
      image.samples.push_back(
          static_cast<std::uint16_t>(65535 * std::clamp(ramp + noise * random.in(-1, 1), 0.0, 1.0)));
    }
  }
  return image;
}

}  // namespace

TEST_CASE("slopes, flow, width and lamp are read from photographs of different spools, lamps, hands and telephones") {
  std::vector<Truth> truths(6, good());
  truths[1].slopes = {6, 13};
  truths[1].tilt = 35;
  truths[1].quality = 60;
  truths[1].lamp = {200, 40, 0.01};
  truths[2].slopes = {4.5, 15.8};
  truths[2].curve = photo::ToneCurve::Soft;
  truths[2].tilt = 12;
  truths[2].filament = {0.7, 0.5, 0.1};
  truths[2].roll = 260;
  truths[3].curve = photo::ToneCurve::Lifted;
  truths[3].tiltAzimuth = 20;
  truths[3].lamp = {110, 45, 0.02};
  truths[3].extrusion = 0.98;
  truths[4].slopes = {8.9, 15.6};
  truths[4].roll = 130;
  truths[4].extrusion = 1.04;
  truths[4].ground = {0.003, 0.003, 0.003};
  truths[5].slopes = {3, 12};
  truths[5].noise = 0.015;
  truths[5].vignette = 0.3;
  truths[5].lamp = {320, 52, 0.02};
  truths[5].lampDistance = 600;
  for (std::size_t k = 0; k < truths.size(); ++k) {
    CAPTURE(k);
    const Truth& truth = truths[k];
    const auto read = readBack(truth);
    if (!read) {
      FAIL_CHECK(read.error().message);
      continue;
    }
    const CouponReading& r = read.value();
    MESSAGE(k << ": along " << r.along.value << " +- " << r.along.error << " of " << truth.slopes.along << ", across "
              << r.across.value << " +- " << r.across.error << " of " << truth.slopes.across << ", width "
              << r.width.value << " +- " << r.width.error << " of " << 0.4 * coupon().print.flow * truth.extrusion
              << ", flow " << (r.flow ? r.flow->value : -1) << " of " << 1 / truth.extrusion << ", lamp "
              << r.azimuth.value << ", " << r.elevation.value << " +- " << r.elevation.error << " of "
              << truth.lamp.azimuth << ", " << truth.lamp.elevation);
    CHECK(std::abs(r.along.value / truth.slopes.along - 1) < 0.12);
    CHECK(std::abs(r.across.value / truth.slopes.across - 1) < 0.15);
    // Noise hides the beads' edges, and the error bars say so.
    CHECK(std::abs(r.width.value - 0.4 * coupon().print.flow * truth.extrusion) < std::max(0.01, 2 * r.width.error));
    CHECK(r.width.error < 0.015);
    CHECK((r.flow.has_value() || truth.noise > 0.01));
    if (r.flow) CHECK(std::abs(r.flow->value - 1 / truth.extrusion) < 0.015);
    const double turn = (r.azimuth.value - truth.lamp.azimuth) / 360;
    CHECK(std::abs(turn - std::round(turn)) * 360 < 3);
    CHECK(std::abs(r.elevation.value - truth.lamp.elevation) < 7);
    CHECK(std::abs(r.tilt - truth.tilt) < 3);
    for (const Measured& m : {r.along, r.across, r.width, r.azimuth, r.elevation}) CHECK(m.error > 0);
  }
}

TEST_CASE("what was read is a file of spools that can be read") {
  CouponReading read;
  read.along = {2.345, 0.1};
  read.across = {60, 1};
  read.colour = {1, 2, 3};
  const auto spools = readSpools(spoolFile(read, "my-Silk", "somebody \"else\""));
  REQUIRE(spools.ok());
  REQUIRE(spools.value().size() == 1);
  CHECK(spools.value()[0].key == "my-Silk");
  CHECK(spools.value()[0].colour[2] == 3);
  CHECK(roughnessOf(spools.value()[0], 0.8, true).along == doctest::Approx(2.35).epsilon(0.003));
  CHECK(roughnessOf(spools.value()[0], 0.4, false).across == 45);
  CHECK(!readSpools(spoolFile(read, "bluePla", "")).ok());
}

TEST_CASE("photographs that nothing can be read from are refused, each with its reason") {
  Truth truth = good();
  truth.shift = {0, 420};
  CHECK(refused(truth) != "read");
  truth = good();
  truth.blur = 6;
  CHECK(refused(goodOne(truth)).find("blurred") != std::string::npos);
  truth = good();
  truth.exposure = 6;
  CHECK(refused(goodOne(truth)).find("burnt") != std::string::npos);
  truth = good();
  truth.focal /= 2.5;
  CHECK(refused(truth).find("pixels wide") != std::string::npos);
  truth = good();
  truth.lamp.slope = 0.4;
  PhotoRequest window;
  window.lampSlope = 0.4;
  CHECK(refused(truth, window) != "read");
}

TEST_CASE("other pictures are refused quickly, whatever they are") {
  CHECK(refused(picture(1, 1, 3, 1, 0)).find("at least 200") != std::string::npos);
  CHECK(refused(picture(4000, 100, 1, 1, 0)).find("at least 200") != std::string::npos);
  CHECK(refused(picture(600, 500, 3, 1, 0)) != "read");
  CHECK(refused(picture(600, 500, 4, 2, 0.5)) != "read");
  CHECK(refused(picture(600, 500, 2, 3, 10)) != "read");
  Image flat{400, 300, 1, std::vector<std::uint16_t>(400 * 300, 30000)};
  CHECK(refused(flat).find("no coupon") != std::string::npos);
  for (int y = 60; y < 240; ++y) {
    for (int x = 110; x < 290; ++x) flat.samples[static_cast<std::size_t>(y * 400 + x)] = 5000;
  }
  CHECK(refused(flat) != "read");  // a square, and nothing on it
  Image wrong{300, 300, 3, {1, 2, 3}};
  CHECK(refused(wrong).find("samples differ") != std::string::npos);
  Image huge{100000, 100000, 1, {}};
  CHECK(refused(huge) != "read");
  PhotoRequest request;
  request.lampSlope = 3;
  CHECK(refused(flat, request).find("lamp size is 3") != std::string::npos);
  request.lampSlope = {};
  request.lampElevation = std::nan("");
  CHECK(refused(flat, request).find("lamp elevation") != std::string::npos);
  RunContext stopped(1);
  stopped.requestCancel();
  CHECK(!readCouponPhoto(goodOne(good()), {}, stopped).ok());
}
