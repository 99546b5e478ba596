#include "sillon/look/preview.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "sillon/input/image_io.hpp"

namespace {

using sillon::Cycle;
using sillon::Image;
using sillon::Toolpath;
using sillon::Vec2;
using sillon::Vec2f;

constexpr float kSpacing = 0.4f;

/// Parallel beads over a square of 20 mm, there and back.
Toolpath hatched(double degrees) {
  const double angle = degrees * 3.14159265358979323846 / 180;
  const Vec2f along{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  const Vec2f across{-along.y, along.x};
  Cycle cycle;
  for (int row = -20; row < 20; ++row) {
    const Vec2f middle = Vec2f{10, 10} + across * (static_cast<float>(row) * kSpacing);
    const float end = row % 2 == 0 ? 8.0f : -8.0f;
    for (const float at : {-end, end}) {
      cycle.points.push_back(middle + along * at);
      cycle.widths.push_back(kSpacing);
    }
  }
  return {{cycle}, kSpacing};
}

Image decoded(const std::vector<std::uint8_t>& png) {
  const auto image = sillon::decodeImage(png, "view");
  REQUIRE(image);
  return image.value();
}

std::string textOf(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

TEST_CASE("a texel tells the direction, cover and width of the beads in it") {
  for (const int eighth : {0, 1, 2, 3, 4, 5, 6, 7}) {
    CAPTURE(eighth);
    const auto file = sillon::viewFile(hatched(eighth * 22.5), {20, 20}, {});
    REQUIRE(file);
    const Image image = decoded(file.value());
    CHECK(image.width == 200);  // 4 texels per bead
    CHECK(image.height == 200);
    const int difference = (image.at(99, 99, 0) / 257 - eighth * 32 + 256 + 128) % 256 - 128;
    CHECK(std::abs(difference) <= 1);
    CHECK(image.at(99, 99, 1) == 65535);
    CHECK(image.at(99, 99, 2) == 128 * 257);
    CHECK(image.at(0, 0, 1) == 0);
  }
}

TEST_CASE("row 0 lies on top") {
  const Toolpath toolpath{{{{{5, 18}, {15, 18}, {15, 18.4f}, {5, 18.4f}}, {0.4f, 0.4f, 0.4f, 0.4f}}}, kSpacing};
  const auto file = sillon::viewFile(toolpath, {20, 20}, {});
  REQUIRE(file);
  const Image image = decoded(file.value());
  CHECK(image.at(99, 18, 1) > 0);
  CHECK(image.at(99, 181, 1) == 0);
}

TEST_CASE("page, spacing and look are told as whole numbers") {
  const auto file = sillon::viewFile(hatched(30), {20, 20.5}, {{1, 2, 255}, {2.345, 20.9}});
  REQUIRE(file);
  CHECK(textOf(file.value()).find("sillon-view 1 page 20000 20500 spacing 400 colour 1 2 255 slopes 235 2090") !=
        std::string::npos);
}

TEST_CASE("the file stays small, whatever the plate") {
  const Vec2 page{400, 400};
  Toolpath toolpath{{}, 0.2};
  Cycle cycle;
  std::uint32_t random = 1;
  const auto next = [&random] {
    return static_cast<float>((random = random * 1664525u + 1013904223u) >> 8) / 41943.04f;
  };
  for (int k = 0; k < 40000; ++k) {
    cycle.points.push_back({next(), next()});
    cycle.widths.push_back(0.2f);
  }
  // Short pieces everywhere: noise, which no picture format makes smaller.
  for (std::size_t k = 1; k < cycle.points.size(); k += 2)
    cycle.points[k] = cycle.points[k - 1] + Vec2f{0.5f, next() / 400};
  for (std::size_t k = 0; k < cycle.points.size(); k += 2) {
    toolpath.cycles.push_back({{cycle.points[k], cycle.points[k + 1]}, {2.0f, 2.0f}});
  }
  const auto file = sillon::viewFile(toolpath, page, {});
  REQUIRE(file);
  CHECK(file.value().size() <= 200 * 1024);
  CHECK(decoded(file.value()).width > 100);
}

TEST_CASE("what cannot be shown is refused with its range") {
  const auto message = [](const Toolpath& toolpath, Vec2 page, const sillon::ViewParams& params) {
    const auto file = sillon::viewFile(toolpath, page, params);
    return file ? std::string() : file.error().message;
  };
  Toolpath odd = hatched(0);
  CHECK(message(odd, {0, 20}, {}).find("page") != std::string::npos);
  CHECK(message(odd, {20, NAN}, {}).find("page") != std::string::npos);
  CHECK(message(odd, {20, 20}, {{}, {0, 10}}).find("0.1 to 45") != std::string::npos);
  odd.spacing = 0;
  CHECK(message(odd, {20, 20}, {}).find("spacing") != std::string::npos);
  odd = hatched(0);
  odd.cycles[0].points[3].x = NAN;
  CHECK(message(odd, {20, 20}, {}).find("point") != std::string::npos);
  odd = hatched(0);
  odd.cycles[0].widths.pop_back();
  CHECK(message(odd, {20, 20}, {}).find("widths") != std::string::npos);
  CHECK(message({{}, kSpacing}, {20, 20}, {}).empty());
  CHECK(message(hatched(0), {1e5, 0.01}, {}).empty());
}
