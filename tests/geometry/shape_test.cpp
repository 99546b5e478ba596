#include "sillon/geometry/shape.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using scenes::shoelace;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Rings of masks turn all the same way around the inside, so that the signed sum is the area.
double signedArea(const Shape& shape) {
  double sum = 0;
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) sum += shoelace(ring);
  }
  return sum;
}

Shape get(const Result<Shape>& shape) {
  if (!shape.ok()) FAIL(shape.error().message);
  return shape.value();
}

void checkRefused(const Result<Shape>& shape, ErrorCode code, const std::string& word) {
  REQUIRE_FALSE(shape.ok());
  INFO(shape.error().message);
  CHECK(shape.error().code == code);
  CHECK(shape.error().message.find(word) != std::string::npos);
}

// '#' bright, ' ' dark, digits 0..9 in ninths.
Image picture(const std::vector<std::string>& rows) {
  Image image;
  image.width = static_cast<int>(rows[0].size());
  image.height = static_cast<int>(rows.size());
  image.channels = 1;
  for (const std::string& row : rows) {
    for (const char c : row) {
      const int ninths = c == '#' ? 9 : c == ' ' ? 0 : c - '0';
      image.samples.push_back(static_cast<std::uint16_t>(ninths * 65535 / 9));
    }
  }
  return image;
}

std::uint64_t hash(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

TEST_CASE("a rectangle is its page") {
  const Shape shape = get(makeRectangle({30, 20.5}));
  CHECK(shape.page == Vec2{30, 20.5});
  REQUIRE(shape.paths.size() == 1);
  CHECK(shape.paths[0].rings == std::vector<Ring>{{{0, 0}, {30, 0}, {30, 20.5}, {0, 20.5}}});
}

TEST_CASE("a disc stays within 0.001 mm of its circle and touches its page") {
  for (const double diameter : {0.01, 0.5, 30.0, 199.7, 10000.0}) {
    CAPTURE(diameter);
    const Shape shape = get(makeDisc(diameter));
    CHECK(shape.page == Vec2{diameter, diameter});
    const Bounds box = bounds(shape);
    CHECK(box.min == Vec2{0, 0});
    CHECK(box.max == Vec2{diameter, diameter});
    const Ring& ring = shape.paths.at(0).rings.at(0);
    const Vec2 center{diameter / 2, diameter / 2};
    double worst = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i] - center, b = ring[(i + 1) % ring.size()] - center;
      worst = std::max({worst, std::abs(length(a) - diameter / 2), std::abs(length(0.5 * (a + b)) - diameter / 2)});
      CHECK(ring[i].x == std::round(ring[i].x * 1e6) / 1e6);
    }
    CHECK(worst < 0.001 + 1e-6);
    CHECK(shoelace(ring) == about(std::numbers::pi / 4 * diameter * diameter, std::min(0.1, 0.01 / diameter)));
  }
}

TEST_CASE("a rounded rectangle loses its corners, never more than half its shorter side") {
  const auto area = [](double radius) { return signedArea(get(makeRoundedRectangle({40, 20}, radius))); };
  CHECK(area(0) == 800);
  CHECK(area(5) == about(800 - (4 - std::numbers::pi) * 25, 5e-5));
  CHECK(area(10) == about(800 - (4 - std::numbers::pi) * 100, 1e-4));
  CHECK(area(1e6) == area(10));
  const Shape shape = get(makeRoundedRectangle({40, 20}, 5));
  CHECK(shape.page == Vec2{40, 20});
  CHECK(bounds(shape).min == Vec2{0, 0});
  CHECK(bounds(shape).max == Vec2{40, 20});
  CHECK(get(makeRoundedRectangle({40, 20}, 10)).paths[0].rings[0].size() > 20);
  const Ring& ring = shape.paths[0].rings[0];
  for (std::size_t i = 0; i < ring.size(); ++i) CHECK_FALSE(ring[i] == ring[(i + 1) % ring.size()]);
}

TEST_CASE("sizes out of range are refused with their value") {
  for (const double size : {0.0, -3.0, 10000.5, 1e300, kNan, kInfinity}) {
    CAPTURE(size);
    checkRefused(makeRectangle({size, 5}), ErrorCode::InvalidArgument, "shape.size.x");
    checkRefused(makeRectangle({5, size}), ErrorCode::InvalidArgument, "shape.size.y");
    checkRefused(makeRoundedRectangle({size, 5}, 1), ErrorCode::InvalidArgument, "shape.size.x");
    checkRefused(makeDisc(size), ErrorCode::InvalidArgument, "shape.size.x");
    checkRefused(shapeFromMask(picture({"#"}), size), ErrorCode::InvalidArgument, "shape.size.x");
  }
  checkRefused(makeRectangle({-0.4, 5}), ErrorCode::InvalidArgument,
               "is -0.4 mm; it must be more than 0 and at most 10000 mm");
  checkRefused(makeRectangle({kNan, 5}), ErrorCode::InvalidArgument, "not a number");
  for (const double radius : {-1.0, kNan}) {
    checkRefused(makeRoundedRectangle({5, 5}, radius), ErrorCode::InvalidArgument, "radius");
  }
  checkRefused(shapeFromMask(picture({"#", "#", "#"}), 9000), ErrorCode::InvalidArgument, "height");
}

TEST_CASE("a white mask is its page, corners and all") {
  const Shape shape = get(shapeFromMask(picture({"####", "####", "####"}), 40));
  CHECK(shape.page == Vec2{40, 30});
  REQUIRE(shape.paths.at(0).rings.size() == 1);
  CHECK(shape.paths[0].rings[0].size() == 4);  // straight runs keep their ends only
  CHECK(std::abs(signedArea(shape)) == doctest::Approx(1200));
  CHECK(bounds(shape).min == Vec2{0, 0});
  CHECK(bounds(shape).max == Vec2{40, 30});
  const Shape single = get(shapeFromMask(picture({"#"}), 30));
  CHECK(std::abs(signedArea(single)) == doctest::Approx(900));
  // A corner that is cut off in the picture stays so.
  CHECK(std::abs(signedArea(get(shapeFromMask(picture({" ##", "###"}), 3)))) == doctest::Approx(6 - 1 - 0.125));
}

TEST_CASE("row 0 of a mask is on top, pixel centres are the samples") {
  // One pixel: a diamond around its centre, half a pixel to each side.
  const Shape shape = get(shapeFromMask(picture({"   ", "  #", "   ", "   "}), 30));
  const Bounds box = bounds(shape);
  CHECK(box.min == Vec2{20, 20});
  CHECK(box.max == Vec2{30, 30});
  CHECK(std::abs(signedArea(shape)) == doctest::Approx(50));
}

TEST_CASE("borders lie where the interpolated brightness is one half") {
  // 8/9 next to 2/9 (above and below one half by 7/18 and 5/18): 7/12 of the way.
  const Shape shape = get(shapeFromMask(picture({"88822", "88822", "88822"}), 5));
  CHECK(bounds(shape).max.x == about(2.5 + 7.0 / 12, 1e-4));
}

TEST_CASE("a smooth mask gives its circle back") {
  const int n = 200;
  Image image;
  image.width = image.height = n;
  image.channels = 1;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const double depth = 70 - std::hypot(x + 0.5 - 110, y + 0.5 - 90);  // [px], centre (110, 90)
      const double level = std::min(1.0, std::max(0.0, 0.5 + depth / 8));
      image.samples.push_back(static_cast<std::uint16_t>(std::lround(level * 65535)));
    }
  }
  const Shape shape = get(shapeFromMask(image, 20));
  REQUIRE(shape.paths.at(0).rings.size() == 1);
  for (const Vec2 p : shape.paths[0].rings[0]) REQUIRE(length(p - Vec2{11, 11}) == about(7, 3e-4));
  CHECK(std::abs(signedArea(shape)) == about(std::numbers::pi * 49, 1e-3));
}

TEST_CASE("holes turn the other way, parts are rings, saddles keep rings apart or join them by their mean") {
  const Shape ring = get(shapeFromMask(picture({"#####", "#   #", "# # #", "#   #", "#####"}), 5));
  REQUIRE(ring.paths.at(0).rings.size() == 3);
  CHECK(std::abs(signedArea(ring)) == about(25 - (9 - 0.5) + 0.5, 0.001));
  // Diagonal neighbours of equal strength: the mean is exactly at the level, which counts as inside.
  CHECK(get(shapeFromMask(picture({"# ", " #"}), 2)).paths[0].rings.size() == 1);
  CHECK(get(shapeFromMask(picture({"6 ", " 6"}), 2)).paths[0].rings.size() == 2);
  CHECK(get(shapeFromMask(picture({"#3", "3#"}), 2)).paths[0].rings.size() == 1);
}

TEST_CASE("random masks: closed rings whose signed area matches the rings of the negative") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Image image, negative;
    image.width = negative.width = 5 + static_cast<int>(seed);
    image.height = negative.height = 17;
    image.channels = negative.channels = 1;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const bool border = x == 0 || y == 0 || x == image.width - 1 || y == image.height - 1;
        const auto i = static_cast<std::uint64_t>(y * image.width + x);
        const auto v = border ? std::uint16_t{0} : static_cast<std::uint16_t>(hash(seed * 1000 + i) & 0xffff);
        image.samples.push_back(v);
        negative.samples.push_back(static_cast<std::uint16_t>(65535 - v));
      }
    }
    const Shape shape = get(shapeFromMask(image, image.width));
    const Shape other = get(shapeFromMask(negative, image.width));
    // Image and negative share all contours; the negative's frame is the page.
    const double page = image.width * image.height;
    CHECK(std::abs(signedArea(shape)) + std::abs(signedArea(other)) == doctest::Approx(page).epsilon(1e-6));
    CHECK(other.paths[0].rings.size() == shape.paths[0].rings.size() + 1);
    for (const Ring& ring : shape.paths[0].rings) {
      REQUIRE(ring.size() >= 3);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        // Neighbouring points are on the border of one cell, unless a straight run was merged.
        const Vec2 step = ring[(i + 1) % ring.size()] - ring[i];
        const bool straight = step.x == 0 || step.y == 0;
        REQUIRE((straight || (std::abs(step.x) <= 1 && std::abs(step.y) <= 1)));
        REQUIRE((step.x != 0 || step.y != 0));
      }
    }
  }
}

TEST_CASE("transparent pictures are read by alpha alone, opaque ones by luma") {
  Image image;
  image.width = 2;
  image.height = 1;
  image.channels = 4;
  const auto left = [](const Shape& shape) { return bounds(shape).max.x < 1.5 && bounds(shape).min.x < 0.5; };
  image.samples = {0, 0, 0, 65535, 65535, 65535, 65535, 0};  // opaque black, transparent white
  CHECK(left(get(shapeFromMask(image, 2))));
  image.samples = {0, 65535, 0, 65535, 65535, 0, 65535, 65535};  // green is bright, magenta is not
  CHECK(left(get(shapeFromMask(image, 2))));
  image.channels = 2;
  image.samples = {0, 65535, 65535, 30000};
  CHECK(left(get(shapeFromMask(image, 2))));
  image.samples = {65535, 65535, 30000, 65535};
  CHECK(left(get(shapeFromMask(image, 2))));
  image.channels = 3;
  image.samples = {65535, 65535, 65535, 65535, 0, 0};
  CHECK(left(get(shapeFromMask(image, 2))));
}

TEST_CASE("masks without bright pixels are empty, masks without pixels invalid, noise too large") {
  checkRefused(shapeFromMask(picture({"44", "00"}), 5), ErrorCode::EmptyShape, "empty");
  checkRefused(shapeFromMask(Image{}, 5), ErrorCode::InvalidArgument, "pixels");
  Image broken = picture({"##"});
  broken.samples.pop_back();
  checkRefused(shapeFromMask(broken, 5), ErrorCode::InvalidArgument, "pixels");
  broken.channels = 7;
  checkRefused(shapeFromMask(broken, 5), ErrorCode::InvalidArgument, "pixels");
  Image noise;
  noise.width = noise.height = 2400;
  noise.channels = 1;
  noise.samples.resize(2400 * 2400);
  for (std::size_t i = 0; i < noise.samples.size(); ++i)
    noise.samples[i] = static_cast<std::uint16_t>(hash(i) & 0xffff);
  checkRefused(shapeFromMask(noise, 100), ErrorCode::TooLarge, "4 million");
}

TEST_CASE("bounds hold all rings, and nothing has empty bounds") {
  CHECK(bounds(Shape{}).empty());
  Shape shape = get(makeRectangle({2, 3}));
  shape.paths.push_back({{{{-5, 1}, {0, 9}, {1, 1}}}, FillRule::NonZero});
  CHECK(bounds(shape).min == Vec2{-5, 0});
  CHECK(bounds(shape).max == Vec2{2, 9});
}
