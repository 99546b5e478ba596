#include "sillon/input/plate_input.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/about.hpp"

using namespace sillon;

namespace {

constexpr double kHalfUnit = 0.5 / 65535 * 180 + 1e-9;  // [degrees]

Image grey(std::vector<std::uint16_t> samples) { return {static_cast<int>(samples.size()), 1, 1, std::move(samples)}; }

std::uint16_t byte(int value) { return static_cast<std::uint16_t>(value * 257); }

double degrees(std::uint16_t angle) { return angle / 65535.0 * 180 - 90; }

/// Between two lines, in degrees, 0..90.
double apart(double a, double b) { return std::abs(std::remainder(a - b, 180.0)); }

double tangentOf(int red, int green) {
  const auto map = directionMap(Image{1, 1, 3, {byte(red), byte(green), byte(255)}}, DirectionEncoding::Tangent);
  REQUIRE(map.ok());
  return degrees(map.value().angle[0]);
}

}  // namespace

TEST_CASE("grey 0 to 1 is -90 to 90 degrees, exactly") {
  const auto map = directionMap(grey({0, 65535, byte(127), byte(128), 12345}), DirectionEncoding::Angle);
  REQUIRE(map.ok());
  CHECK(map.value().width == 5);
  CHECK(map.value().height == 1);
  const auto& angle = map.value().angle;
  CHECK(degrees(angle[0]) == -90);
  CHECK(degrees(angle[1]) == 90);
  CHECK(degrees(angle[2]) == about(-0.3529, 0.001));
  CHECK(degrees(angle[2]) + degrees(angle[3]) == doctest::Approx(0));  // 127.5 would be horizontal
  CHECK(angle[4] == 12345);
}

TEST_CASE("colour counts by its luma, equal channels exactly, alpha never") {
  for (const std::uint32_t value : {0u, 1u, 127u * 257, 32767u, 32768u, 65534u, 65535u}) {
    const auto g = static_cast<std::uint16_t>(value);
    const auto map = directionMap(Image{2, 1, 4, {g, g, g, 0, g, g, g, 65535}}, DirectionEncoding::Angle);
    REQUIRE(map.ok());
    CHECK(map.value().angle == std::vector<std::uint16_t>{g, g});
  }
  const auto primaries =
      directionMap(Image{3, 1, 3, {65535, 0, 0, 0, 65535, 0, 0, 0, 65535}}, DirectionEncoding::Angle);
  REQUIRE(primaries.ok());
  CHECK(primaries.value().angle[0] == about(0.2126 * 65535, 0.0001));
  CHECK(primaries.value().angle[1] == about(0.7152 * 65535, 0.0001));
  CHECK(primaries.value().angle[2] == about(0.0722 * 65535, 0.0001));
  const auto greyAlpha = directionMap(Image{1, 1, 2, {777, 3}}, DirectionEncoding::Angle);
  REQUIRE(greyAlpha.ok());
  CHECK(greyAlpha.value().angle[0] == 777);
}

TEST_CASE("a rotation map is the same grey turned by 90 degrees") {
  std::vector<std::uint16_t> samples;
  for (std::uint32_t k = 0; k <= 65535; ++k) samples.push_back(static_cast<std::uint16_t>(k));
  const auto map = directionMap(grey(samples), DirectionEncoding::Rotation);
  REQUIRE(map.ok());
  double worst = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    worst = std::max(worst, apart(degrees(map.value().angle[k]), samples[k] / 65535.0 * 180));
  }
  CHECK(worst <= kHalfUnit);
}

TEST_CASE("a tangent is a line: opposite vectors are one direction, in all quadrants") {
  CHECK(apart(tangentOf(255, 255), 45) <= kHalfUnit);
  CHECK(apart(tangentOf(0, 0), 45) <= kHalfUnit);
  CHECK(apart(tangentOf(0, 255), -45) <= kHalfUnit);
  CHECK(apart(tangentOf(255, 0), -45) <= kHalfUnit);
  CHECK(apart(tangentOf(255, 128), 0) < 0.23);  // 8 bits cannot say one half
  CHECK(apart(tangentOf(0, 127), 0) < 0.23);
  CHECK(apart(tangentOf(128, 255), 90) < 0.23);
  CHECK(apart(tangentOf(127, 0), 90) < 0.23);
  for (int red = 0; red < 256; red += 15) {
    for (int green = 0; green < 256; green += 15) {
      if (std::abs(2 * red - 255) <= 1 && std::abs(2 * green - 255) <= 1) continue;
      const double expected = std::atan2(2.0 * green - 255, 2.0 * red - 255) * 180 / 3.14159265358979323846;
      CHECK(apart(tangentOf(red, green), expected) <= kHalfUnit);
      CHECK(apart(tangentOf(red, green), tangentOf(255 - red, 255 - green)) <= 2 * kHalfUnit);
    }
  }
}

TEST_CASE("a tangent without direction is 0 degrees") {
  for (const int red : {127, 128}) {
    for (const int green : {127, 128}) CHECK(std::abs(tangentOf(red, green)) <= kHalfUnit);
  }
  CHECK(apart(tangentOf(127, 130), 0) > 45);
}

TEST_CASE("tangents need red and green") {
  for (const int channels : {1, 2}) {
    Image image{1, 1, channels, std::vector<std::uint16_t>(static_cast<std::size_t>(channels))};
    const auto map = directionMap(image, DirectionEncoding::Tangent);
    REQUIRE_FALSE(map.ok());
    CHECK(map.error().code == ErrorCode::InvalidArgument);
    CHECK(map.error().message.find("red and green") != std::string::npos);
  }
}

TEST_CASE("one angle makes a map of one texel, whatever its number of turns") {
  for (const double angle : {0.0, 45.0, -90.0, 90.0, 135.0, 180.0, -720.0, 1234.5, 89.9999, 1e15}) {
    CAPTURE(angle);
    const auto map = uniformDirection(angle);
    REQUIRE(map.ok());
    CHECK(map.value().width == 1);
    CHECK(map.value().height == 1);
    REQUIRE(map.value().angle.size() == 1);
    CHECK(apart(degrees(map.value().angle[0]), std::fmod(angle, 180.0)) <= kHalfUnit);
  }
  CHECK_FALSE(uniformDirection(std::numeric_limits<double>::quiet_NaN()).ok());
  CHECK_FALSE(uniformDirection(-std::numeric_limits<double>::infinity()).ok());
}

TEST_CASE("modes are the nearest of 0, 84, 168 and 255, stray greys included") {
  using M = DirectionMode;
  const auto map = modeMap(grey({byte(0), byte(84), byte(168), byte(255), byte(250), byte(251), byte(42), byte(43),
                                 byte(127), byte(128), byte(212), byte(213)}));
  REQUIRE(map.ok());
  CHECK(map.value().mode == std::vector<M>{M::Parallel, M::Orthogonal, M::Smoothest, M::Constrained, M::Constrained,
                                           M::Constrained, M::Parallel, M::Orthogonal, M::Orthogonal, M::Smoothest,
                                           M::Smoothest, M::Constrained});
  const auto coloured = modeMap(Image{1, 1, 3, {byte(84), byte(84), byte(84)}});
  REQUIRE(coloured.ok());
  CHECK(coloured.value().mode[0] == M::Orthogonal);
  CHECK(uniformMode(M::Smoothest).mode == std::vector<M>{M::Smoothest});
}

TEST_CASE("pictures without pixels, or with too few samples, are errors") {
  const std::vector<Image> images{
      {}, {2, 2, 1, {1, 2, 3}}, {-1, -1, 1, {1}}, {1, 1, 5, {1, 2, 3, 4, 5}}, {1, 1, 0, {}}};
  for (const Image& image : images) {
    CHECK_FALSE(directionMap(image, DirectionEncoding::Angle).ok());
    CHECK_FALSE(directionMap(image, DirectionEncoding::Tangent).ok());
    CHECK_FALSE(modeMap(image).ok());
  }
}
