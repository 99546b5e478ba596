// Photographs of coupons whose beads, lamp and camera are known, and pictures that are none.
#include "sillon/calibrate/calibrate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sillon/look/appearance.hpp"
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

/// The good photograph, developed otherwise.
std::vector<std::uint8_t> goodFile(const Truth& truth) {
  static const photo::Exposed film = photo::exposed(coupon(), good());
  return photo::developed(film, truth);
}
Image goodOne(const Truth& truth) { return decoded(goodFile(truth)); }

Result<CouponReading> readBack(const Truth& truth) { return photo::readBack(coupon(), truth); }

std::string refused(const Image& image, const PhotoRequest& request = {}) {
  const auto read = readCouponPhoto(image, request, RunContext(1));
  return read ? "read" : read.error().message;
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
  truths[2].tilt = 12;  // hardly any perspective, and no telephone's focal length
  truths[2].distance = 300;
  truths[2].focal = 2.8;
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
    CHECK(std::abs(r.along.value / truth.slopes.along - 1) < 0.1);
    CHECK(std::abs(r.across.value / truth.slopes.across - 1) < 0.05);
    CHECK(std::abs(r.width.value - 0.4 * coupon().print.flow * truth.extrusion) < 0.005);
    CHECK(r.width.error < 0.015);
    REQUIRE(r.flow.has_value());
    CHECK(std::abs(r.flow->value - 1 / truth.extrusion) < (truth.noise > 0.01 ? 0.01 : 0.006));  // it hides edges
    const double turn = (r.azimuth.value - truth.lamp.azimuth) / 360;
    CHECK(std::abs(turn - std::round(turn)) * 360 < 2);
    CHECK(std::abs(r.elevation.value - truth.lamp.elevation) < 2);
    CHECK(std::abs(r.tilt - truth.tilt) < 3);
    for (const Measured& m : {r.along, r.across, r.width, r.azimuth, r.elevation}) CHECK(m.error > 0);
  }
}

TEST_CASE("however a telephone develops a photograph, the same is read, and from all together no more surely") {
  std::vector<Truth> ways(8, good());
  ways[0].quality = 0;
  ways[0].noise = 0.003;
  ways[1].curve = photo::ToneCurve::Soft;
  ways[2].curve = photo::ToneCurve::Vivid;
  ways[3].curve = photo::ToneCurve::Lifted;
  ways[4].quality = 55;
  ways[5].noise = 0.015;
  ways[6].blur = 1;
  ways[7].exposure = 0.45;
  ways[7].curve = photo::ToneCurve::Soft;
  std::vector<CouponReading> all;
  double farthest = 0, surest = 1e9;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    CAPTURE(k);
    const auto read = readCouponPhoto(goodOne(ways[k]), {}, RunContext(1));
    REQUIRE(read.ok());
    const CouponReading& r = read.value();
    MESSAGE(k << ": along " << r.along.value << " +- " << r.along.error << ", across " << r.across.value << " +- "
              << r.across.error << ", width " << r.width.value << ", flow " << (r.flow ? r.flow->value : -1)
              << ", lamp " << r.elevation.value);
    CHECK(std::abs(r.along.value / ways[k].slopes.along - 1) < 0.08);
    CHECK(std::abs(r.across.value / ways[k].slopes.across - 1) < 0.08);
    CHECK(std::abs(r.width.value - 0.38) < 0.005);
    REQUIRE(r.flow.has_value());
    CHECK(std::abs(r.flow->value - 1) < 0.008);
    farthest = std::max(farthest, std::abs(r.flow->value - 1));
    surest = std::min(surest, r.across.error);
    all.push_back(r);
  }
  const auto together = joinReadings(all, {});
  REQUIRE(together.ok());
  const CouponReading& r = together.value();
  MESSAGE("together: along " << r.along.value << " +- " << r.along.error << ", across " << r.across.value << " +- "
                             << r.across.error << ", width " << r.width.value << ", flow " << r.flow->value << " +- "
                             << r.flow->error);
  CHECK(std::abs(r.across.value / good().slopes.across - 1) < 0.05);
  CHECK(std::abs(r.flow->value - 1) < std::max(0.005, farthest));
  CHECK(r.lamps == 1);  // they are one photograph
  CHECK(r.across.error > 0.95 * surest);
  CHECK(r.across.error < 1.5 * all[0].across.error);
}

TEST_CASE("a glossy spool, of which a photograph shows few directions, is read") {
  photo::Random random(0);
  Truth truth;
  for (int k = 0; k < 9; ++k) truth = photo::randomTruth(random);
  REQUIRE(truth.slopes.along < 2);
  const auto read = readBack(truth);
  REQUIRE(read.ok());
  CHECK(std::abs(read.value().along.value - truth.slopes.along) < 2 * read.value().along.error);
  CHECK(std::abs(read.value().across.value - truth.slopes.across) < 2 * read.value().across.error);
  CHECK(std::abs(read.value().width.value - 0.38 * truth.extrusion) < 0.01);
}

TEST_CASE("readings of one coupon are joined by their error bars") {
  int taken = 0;
  const auto reading = [&taken](double along, double error, double flow) {
    CouponReading r;
    r.azimuth = {7.2 * (taken % 50), 1};  // each under another lamp
    r.elevation = {taken % 2 == 0 ? 35.0 : 55.0, 2};
    ++taken;
    r.along = {along, error};
    r.across = {15, 0.5};
    if (flow > 0) r.flow = Measured{flow, 0.01};
    r.width = {0.38, 0.004};
    return r;
  };
  PhotoRequest point;
  point.lampSlope = 0;
  // A bar of a third counts nine times as much; 3 % of a slope all photographs are off by alike.
  const auto two = joinReadings(
      {reading(4, 4 * std::hypot(0.1, 0.03), 0.99), reading(4.4, 4.4 * std::hypot(0.1 / 3, 0.03), 1.01)}, point);
  REQUIRE(two.ok());
  CHECK(two.value().along.value == doctest::Approx(4.358).epsilon(0.001));
  CHECK(two.value().along.error == doctest::Approx(4.358 * std::hypot(0.1 / std::sqrt(10), 0.03)).epsilon(0.01));
  CHECK(two.value().flow->value == doctest::Approx(1));
  // What the lamp hides, it hides in all of them.
  std::vector<CouponReading> many;
  for (int k = 0; k < 50; ++k) many.push_back(reading(2, 0.3, 0));
  CHECK(joinReadings(many, {}).value().lamps == 50);
  CHECK(joinReadings(many, {}).value().along.error > 0.2);
  CHECK(joinReadings(many, point).value().along.error < 0.08);
  CHECK(!joinReadings(many, {}).value().flow.has_value());
  // Farther apart than their bars: less sure.
  CHECK(joinReadings({reading(4, 0.1, 1), reading(5, 0.1, 1)}, point).value().along.error > 0.4);
  const auto other = joinReadings({reading(3, 0.1, 1), reading(3, 0.1, 1), reading(8, 0.2, 1)}, point);
  REQUIRE(!other.ok());
  CHECK(other.error().message.find("photograph 3 has slopes of 8.0 degrees, and") == 0);
  CHECK(joinReadings({reading(3, 0.1, 1)}, {}).value().along.value == 3);
  CHECK(!joinReadings({}, {}).ok());
}

TEST_CASE("photographs under one lamp count as one, copies among them") {
  const auto under = [](double azimuth, double across, double flow) {
    CouponReading r;
    r.along = {4, 0.4};
    r.across = {across, 0.6};
    r.flow = Measured{flow, 0.01};
    r.width = {0.38, 0.004};
    r.azimuth = {azimuth, 1};
    r.elevation = {45, 1};
    return r;
  };
  const CouponReading one = under(60, 15, 1);
  const auto copies = joinReadings({one, one, one}, {});
  REQUIRE(copies.ok());
  CHECK(copies.value().lamps == 1);
  CHECK(copies.value().across.value == doctest::Approx(15));
  CHECK(copies.value().across.error == doctest::Approx(0.6));
  CHECK(copies.value().along.error == doctest::Approx(0.4));
  CHECK(copies.value().flow->error == doctest::Approx(0.01));
  CHECK(copies.value().width.error == doctest::Approx(0.004));
  // The lamp at 358 degrees stands beside that at 3. Two places: the root of two less, and equal shares.
  const auto pair = joinReadings({under(358, 15, 1), under(3, 15, 1), under(90, 15, 0.98)}, {});
  REQUIRE(pair.ok());
  CHECK(pair.value().lamps == 2);
  CHECK(pair.value().flow->value == doctest::Approx(0.99));
  CHECK(pair.value().width.error == doctest::Approx(0.004 / std::sqrt(2.0)));
  // Copies that were developed otherwise and differ are less sure than either.
  CHECK(joinReadings({one, under(61, 12, 1)}, {}).value().across.error > 1);
}

TEST_CASE("stray light and sharpening are told from the surface") {
  std::vector<Truth> ways(7, good());
  ways[1].veil = 0.05;
  ways[2].veil = 0.2;
  ways[3].veilRight = 0.15;
  ways[4].sharpen = 1;
  ways[5].sharpen = 0.8, ways[5].mask = 1.5;
  ways[6].sharpen = 1.5, ways[6].mask = 2;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    CAPTURE(k);
    const auto read = readCouponPhoto(goodOne(ways[k]), {}, RunContext(1));
    if (!read) {
      FAIL_CHECK(read.error().message);
      continue;
    }
    const CouponReading& r = read.value();
    MESSAGE(k << ": along " << r.along.value << " +- " << r.along.error << ", across " << r.across.value << " +- "
              << r.across.error << ", flow " << (r.flow ? r.flow->value : -1) << ", lamp " << r.elevation.value
              << " +- " << r.elevation.error << ", veil " << r.veil << ", sharpening " << r.sharpening);
    CHECK(std::abs(r.along.value - good().slopes.along) < 2 * r.along.error);
    CHECK(std::abs(r.across.value / good().slopes.across - 1) < 0.05);
    REQUIRE(r.flow.has_value());
    CHECK(std::abs(r.flow->value - 1) < 0.008);
    CHECK(std::abs(r.elevation.value - good().lamp.elevation) < 4);
    const bool veiled = k >= 1 && k <= 3, sharpened = k >= 4;
    CHECK((veiled ? r.veil > 0.05 : std::abs(r.veil) < 0.01));
    CHECK((sharpened ? r.sharpening > 0.3 : std::abs(r.sharpening) < 0.1));
  }
}

TEST_CASE("an elevation that the photograph contradicts is refused with both values") {
  const Image image = goodOne(good());
  for (const double wrong : {20.0, 34.0, 65.0}) {
    CAPTURE(wrong);
    PhotoRequest request;
    request.lampElevation = wrong;
    const auto read = readCouponPhoto(image, request, RunContext(1));
    REQUIRE(!read.ok());
    CHECK(read.error().code == ErrorCode::InvalidArgument);
    CAPTURE(read.error().message);
    CHECK(read.error().message.find("lamp elevation is " + std::to_string(static_cast<int>(wrong)) + " degrees") == 0);
    CHECK(read.error().message.find("shows the lamp at 4") != std::string::npos);
  }
  for (const double right : {41.0, 45.0, 50.0}) {
    PhotoRequest request;
    request.lampElevation = right;
    CHECK(refused(image, request) == "read");
  }
}

TEST_CASE("whether all discs are closed or none is told only where it is sure") {
  const auto with = [](double extrusion) {
    Truth truth = good();
    truth.extrusion = extrusion;
    const auto read = readBack(truth);
    REQUIRE(read.ok());
    return read.value();
  };
  // The discs reach to 1, and a flow is told up to 1.03.
  const CouponReading thin = with(1 / 1.08);
  CHECK(!thin.flow.has_value());
  CHECK(thin.flowIsHigher);
  CHECK(!thin.flowIsLower);
  const CouponReading beside = with(1 / 1.045);
  CHECK(!beside.flow.has_value());
  CHECK(!beside.flowIsHigher);
  CHECK(!beside.flowIsLower);
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
  const auto because = [](const Result<CouponReading>& read, const char* reason) {
    CAPTURE(reason);
    REQUIRE(!read.ok());
    CAPTURE(read.error().message);
    CHECK(read.error().code == ErrorCode::InvalidFile);
    CHECK(read.error().message.find(reason) != std::string::npos);
  };
  const auto developed = [&](auto&& change, const char* reason) {
    Truth truth = good();
    change(truth);
    because(readCouponPhoto(goodOne(truth), {}, RunContext(1)), reason);
  };
  developed([](Truth& t) { t.blur = 2.5; }, "the photograph is blurred, or it shows something else");
  developed([](Truth& t) { t.blur = 6; }, "the photograph is blurred, or it shows something else");
  developed([](Truth& t) { t.exposure = 6; }, "the photograph is burnt");
  developed([](Truth& t) { t.noise = 0.3; }, "does not shine as it would under one lamp");
  developed([](Truth& t) { t.quality = 5; }, "the photograph is blurred by");
  PhotoRequest other;
  other.project.printer.nozzle = 0.6;
  because(readCouponPhoto(goodOne(good()), other, RunContext(1)), "no beads of a coupon are seen on it");
  const auto taken = [&](auto&& change, const char* reason) {
    Truth truth = good();
    change(truth);
    because(readBack(truth), reason);
  };
  taken([](Truth& t) { t.shift = {0, 200}; }, "cut off by the photograph's border");
  taken([](Truth& t) { t.focal /= 2.5; }, "pixels wide in the photograph; it must be at least 4.5");
  taken([](Truth& t) { t.secondLamp = 1; }, "does not shine as it would under one lamp");
  taken([](Truth& t) { t.lamp.slope = 0.4; }, "does not shine as it would under one lamp");  // a window
  taken([](Truth& t) { t.room = 5, t.exposure = 0.1; }, "times as bright as the darkest, and must be 1.5 times");
}

TEST_CASE("a coupon is read either way up, and refused where it is mirrored, cut off or something else") {
  const Image image = goodOne(good());
  const auto upright = readCouponPhoto(image, {}, RunContext(1));
  REQUIRE(upright.ok());
  const auto turned = [&](auto&& from) {
    Image out{image.width, image.height, 3, {}};
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        for (int c = 0; c < 3; ++c) out.samples.push_back(from(x, y, c));
      }
    }
    return out;
  };
  const int w = image.width, h = image.height;
  const auto ground = [&](int c) { return image.at(2, 2, c); };
  const auto down = readCouponPhoto(turned([&](int x, int y, int c) { return image.at(w - 1 - x, h - 1 - y, c); }), {},
                                    RunContext(1));
  REQUIRE(down.ok());
  CHECK(down.value().across.value == doctest::Approx(upright.value().across.value).epsilon(0.03));
  CHECK(down.value().azimuth.value == doctest::Approx(upright.value().azimuth.value).epsilon(0.03));
  CHECK(down.value().width.value == doctest::Approx(upright.value().width.value).epsilon(0.01));
  const std::string none = "no beads of a coupon are seen on it";
  CHECK(refused(turned([&](int x, int y, int c) { return image.at(w - 1 - x, y, c); })).find(none) !=
        std::string::npos);
  // Without its right third, and with a sheet over its upper half.
  CHECK(refused(turned([&](int x, int y, int c) { return image.at(std::min(x + w / 3, w - 1), y, c); })) != "read");
  CHECK(refused(turned([&](int x, int y, int c) { return y < h / 2 ? ground(c) : image.at(x, y, c); })) != "read");
  // Of another shape, as if its pixels were not square.
  for (const double stretch : {1.1, 1.3}) {
    CAPTURE(stretch);
    Image wide{static_cast<int>(w * stretch), h, 3, {}};
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < wide.width; ++x) {
        const double u = std::clamp((x + 0.5) / stretch - 0.5, 0.0, w - 1.001);
        const int i = static_cast<int>(u);
        for (int c = 0; c < 3; ++c) {
          wide.samples.push_back(
              static_cast<std::uint16_t>((1 - (u - i)) * image.at(i, y, c) + (u - i) * image.at(i + 1, y, c)));
        }
      }
    }
    CHECK(refused(wide).find("no camera sees a square like that") == 0);
  }
  // Without a fifth on one side the camera looks past the middle: the lamp's direction is less sure, and says so.
  Image cut{w * 4 / 5, h, 3, {}};
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < 3 * cut.width; ++x) cut.samples.push_back(image.at(x / 3, y, x % 3));
  }
  const auto part = readCouponPhoto(cut, {}, RunContext(1));
  REQUIRE(part.ok());
  CHECK(std::abs(part.value().azimuth.value - good().lamp.azimuth) < 2 * part.value().azimuth.error);
  CHECK(part.value().azimuth.error > 1.5 * upright.value().azimuth.error);
  // Two coupons: one is read, or neither; never something between.
  const auto two = readCouponPhoto(turned([&](int x, int y, int c) {
                                     const int u = 2 * (x % (w / 2)), v = 2 * y - h / 2;
                                     return v < 0 || v >= h ? ground(c) : image.at(u, v, c);
                                   }),
                                   {}, RunContext(1));
  if (two) CHECK(two.value().across.value == doctest::Approx(upright.value().across.value).epsilon(0.15));
  // Rings, a chessboard and letters of noise, as large as a coupon.
  for (int kind = 0; kind < 3; ++kind) {
    CAPTURE(kind);
    scenes::Random random(7);
    CHECK(refused(turned([&](int x, int y, int c) -> std::uint16_t {
            const int u = x - w / 2, v = y - h / 2;
            if (std::abs(u) > 400 || std::abs(v) > 400) return ground(c);
            const double r = std::sqrt(static_cast<double>(u * u + v * v));
            if (kind == 0) return static_cast<std::uint16_t>(12000 + 9000 * std::sin(r));
            if (kind == 1) return (u / 20 + v / 20) % 2 == 0 ? 3000 : 20000;
            return static_cast<std::uint16_t>(random.in(0, 30000));
          })) != "read");
  }
  for (const std::uint16_t all : {std::uint16_t{0}, std::uint16_t{65535}}) {
    CHECK(refused(Image{600, 500, 3, std::vector<std::uint16_t>(600 * 500 * 3, all)}).find("no coupon") !=
          std::string::npos);
  }
}

TEST_CASE("files that are no whole photograph are refused or read rightly, whatever their bytes") {
  const std::vector<std::uint8_t> bytes = goodFile(good());
  const auto tried = [](std::vector<std::uint8_t> file) {
    const auto image = decodeImage(file, "photograph");
    return image ? refused(image.value()) : image.error().message;
  };
  CHECK(tried({}) != "read");
  scenes::Random random(3);
  for (const double part : {0.0005, 0.01, 0.3, 0.6}) {
    CAPTURE(part);
    std::vector<std::uint8_t> cut = bytes;
    cut.resize(static_cast<std::size_t>(part * static_cast<double>(bytes.size())));
    CHECK(tried(cut) != "read");
  }
  for (int k = 0; k < 40; ++k) {
    std::vector<std::uint8_t> any(static_cast<std::size_t>(random.index(2000)));
    for (std::uint8_t& b : any) b = static_cast<std::uint8_t>(random.index(256));
    CHECK(tried(any) != "read");
  }
  // The first marker of a frame says how large it is: 65535 by 65535.
  std::vector<std::uint8_t> huge = bytes;
  for (std::size_t k = 0; k + 9 < huge.size(); ++k) {
    if (huge[k] != 0xFF || huge[k + 1] != 0xC0) continue;
    for (std::size_t j = 5; j < 9; ++j) huge[k + j] = 0xFF;
    break;
  }
  CHECK(tried(huge) != "read");
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
    for (int x = 110; x < 290; ++x) flat.samples[y * 400 + x] = 5000;
  }
  CHECK(refused(flat) != "read");  // a square, and nothing on it
  Image wrong{300, 300, 3, {1, 2, 3}};
  CHECK(refused(wrong).find("3 samples") != std::string::npos);
  Image huge{100000, 100000, 1, {}};
  const auto many = readCouponPhoto(huge, {}, RunContext(1));
  REQUIRE(!many.ok());
  CHECK(many.error().code == ErrorCode::InvalidArgument);  // where are its samples?
  PhotoRequest request;
  request.lampSlope = 3;
  CHECK(refused(flat, request).find("lampSize is 3") != std::string::npos);
  request.lampSlope = {};
  request.lampElevation = std::nan("");
  CHECK(refused(flat, request).find("lampElevation") != std::string::npos);
  RunContext stopped(1);
  stopped.requestCancel();
  const auto unread = readCouponPhoto(goodOne(good()), {}, stopped);
  REQUIRE(!unread.ok());
  CHECK(unread.error().code == ErrorCode::Cancelled);
}
