// Directions read from pictures, in closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "compose/lines.hpp"

using namespace sillon;

namespace {

constexpr double kSpacing = 0.4;

/// \param value  0..1 of a pixel's middle in shares of the picture, y up.
Image greyPicture(int width, int height, const std::function<double(double x, double y)>& value) {
  Image image{width, height, 1, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double grey = value((x + 0.5) / width, 1 - (y + 0.5) / height);
      image.samples.push_back(static_cast<std::uint16_t>(std::lround(65535 * grey)));
    }
  }
  return image;
}

struct Colour {
  int red = 0, green = 0, blue = 0, alpha = 255;
};

Image colourPicture(int width, int height, const std::function<Colour(int x, int y)>& colour) {
  Image image{width, height, 4, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Colour one = colour(x, y);
      for (const int part : {one.red, one.green, one.blue, one.alpha}) {
        image.samples.push_back(static_cast<std::uint16_t>(257 * part));
      }
    }
  }
  return image;
}

/// A picture over a box in the middle of a page of 100 x 100 mm.
struct Read {
  TonesLayer tones;
  Image picture;
  Vec2 box{40, 20};
  Layer layer = {};

  [[nodiscard]] LineAt lines() const {
    LayerContent content;
    content.size = box;
    content.picture = picture;
    const Placement place(layer, {50, 50}, box);
    return tonesLines(tones, content, place, kSpacing);  // all that it has been given is gone when it is asked
  }
  /// [degrees] at places from the middle of the page [mm].
  [[nodiscard]] std::vector<double> at(const std::vector<Vec2>& places) const {
    const LineAt line = lines();
    std::vector<double> angles;
    for (const Vec2 place : places) {
      const Vec2f found = line(Vec2{50, 50} + place);
      CHECK(std::abs(length(found) - 1) < 1e-5F);
      angles.push_back(std::atan2(found.y, found.x) * 90 / std::numbers::pi);
    }
    return angles;
  }
};

/// Difference of two lines [degrees], 0..90.
double apart(double a, double b) { return std::abs(std::remainder(a - b, 180)); }

Read reading(TonesBy by, Image picture, Vec2 box = {40, 20}) {
  Read read;
  read.tones.by = by;
  read.picture = std::move(picture);
  read.box = box;
  return read;
}

Image step(int width = 40, int height = 20) {
  return greyPicture(width, height, [](double x, double) { return x < 0.5 ? 0 : 1; });
}

}  // namespace

TEST_CASE("a step in brightness gives two directions") {
  Read read = reading(TonesBy::Brightness, step());
  read.tones.from = 10;
  read.tones.to = 100;
  const std::vector<double> angles = read.at({{-19, 9}, {-1, -9}, {1, 9}, {19, -9}});
  CHECK(apart(angles[0], 10) < 0.01);
  CHECK(apart(angles[1], 10) < 0.01);
  CHECK(apart(angles[2], 100) < 0.01);
  CHECK(apart(angles[3], 100) < 0.01);
}

TEST_CASE("directions go with the tone, and contrast spreads them about the middle grey") {
  Read read = reading(TonesBy::Brightness, greyPicture(64, 32, [](double x, double) { return x; }));
  read.tones.from = -30;
  read.tones.to = 60;
  for (const double contrast : {1.0, 2.0, 0.0}) {
    read.tones.contrast = contrast;
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const double tone = std::min(1.0, std::max(0.0, (share - 0.5) * contrast + 0.5));
      CHECK(apart(read.at({{40 * (share - 0.5), 3}})[0], -30 + 90 * tone) < 0.3 * std::max(1.0, contrast));
    }
  }
}

TEST_CASE("what is transparent is as light as paper") {
  Read read = reading(TonesBy::Brightness, colourPicture(40, 20, [](int x, int) {
                        return Colour{0, 0, 0, x < 20 ? 255 : 0};
                      }));
  const std::vector<double> angles = read.at({{-10, 0}, {10, 0}});
  CHECK(apart(angles[0], read.tones.from) < 0.01);
  CHECK(apart(angles[1], read.tones.to) < 0.01);
}

TEST_CASE("smoothing blurs the brightness over as many millimetres as it says") {
  Read read = reading(TonesBy::Brightness, step(400, 200));
  read.tones.from = 0;
  read.tones.to = 80;
  read.tones.smoothing = 2;
  const std::vector<double> angles = read.at({{-8, 0}, {-2, 0}, {0.05, 0}, {2, 0}, {8, 0}});
  CHECK(apart(angles[0], 0) < 1);
  CHECK(apart(angles[1], 80 * 0.159) < 3);  // of a Gaussian beyond its sigma
  CHECK(apart(angles[2], 40) < 2);
  CHECK(apart(angles[3], 80 * 0.841) < 3);
  CHECK(apart(angles[4], 80) < 1);
}

TEST_CASE("levels part at the threshold, however coarse the picture is") {
  for (const int width : {10, 100, 2000}) {
    Read read = reading(TonesBy::Levels, greyPicture(width, width / 2, [](double x, double) { return x; }));
    read.tones.from = 20;
    read.tones.to = 70;
    for (const double threshold : {0.3, 0.5, 0.8}) {
      read.tones.threshold = threshold;
      const double border = 40 * (threshold - 0.5);
      const std::vector<double> angles = read.at({{border - 0.15, 2}, {border + 0.15, 2}, {-19.9, 2}, {19.9, 2}});
      CHECK(apart(angles[0], 20) < 0.01);
      CHECK(apart(angles[1], 70) < 0.01);
      CHECK(apart(angles[2], 20) < 0.01);
      CHECK(apart(angles[3], 70) < 0.01);
    }
  }
}

TEST_CASE("lines run along an upright edge, far from it too, and across it at 90 degrees") {
  for (const double angle : {0.0, 90.0, 30.0}) {
    Read read = reading(TonesBy::Edges, step());
    read.tones.angle = angle;
    for (const double found : read.at({{0, 0}, {-19, 9}, {19, -9}, {10, 0}})) CHECK(apart(found, 90 + angle) < 0.1);
  }
}

TEST_CASE("edges have the direction that the picture has on the page") {
  const Image rising = greyPicture(80, 80, [](double x, double y) { return x > y + 0.001 ? 1 : 0; });
  Read square = reading(TonesBy::Edges, rising, {40, 40});
  square.tones.smoothing = 1;  // stairs of pixels
  CHECK(apart(square.at({{0, 0}})[0], 45) < 0.5);
  Read wide = square;
  wide.box = {80, 40};
  CHECK(apart(wide.at({{0, 0}})[0], std::atan(0.5) * 180 / std::numbers::pi) < 0.5);
  Read turned = square;
  turned.layer.rotation = 30;
  CHECK(apart(turned.at({{0, 0}})[0], 75) < 0.5);
  turned.layer.mirror = true;
  CHECK(apart(turned.at({{0, 0}})[0], 165) < 0.5);
  turned.tones.angle = 10;
  CHECK(apart(turned.at({{0, 0}})[0], 175) < 0.5);
}

TEST_CASE("lines run around a disc") {
  const Image disc =
      greyPicture(200, 200, [](double x, double y) { return std::hypot(x - 0.5, y - 0.5) < 0.3 ? 0 : 1; });
  Read read = reading(TonesBy::Edges, disc, {40, 40});
  read.tones.smoothing = 0.5;
  for (int k = 0; k < 24; ++k) {
    const double turn = k * std::numbers::pi / 12;
    const Vec2 rim = Vec2{std::cos(turn), std::sin(turn)} * 12;
    CHECK(apart(read.at({rim})[0], k * 15 + 90) < 2);
  }
}

TEST_CASE("a picture without edges has the direction that its angle says") {
  Read read = reading(TonesBy::Edges, greyPicture(30, 20, [](double, double) { return 0.3; }));
  read.tones.angle = 25;
  CHECK(apart(read.at({{3, 4}})[0], 25) < 0.01);
}

TEST_CASE("flat colours lie in the directions listed for them, and others with the nearest of these") {
  const auto picture = [](int x, int) {
    if (x < 10) return Colour{255, 0, 0};
    if (x < 20) return Colour{0, 0, 255};
    if (x < 30) return Colour{160, 20, 10};
    return Colour{0, 0, 0, 0};
  };
  Read read = reading(TonesBy::Colours, colourPicture(40, 20, picture));
  read.tones.colours = {{"#ff0000", 15}, {"#0000FF", 120}};
  const std::vector<double> angles = read.at({{-15, 0}, {-5, 0}, {5, 0}, {15, 0}});
  CHECK(apart(angles[0], 15) < 0.01);
  CHECK(apart(angles[1], 120) < 0.01);
  CHECK(apart(angles[2], 15) < 0.01);
  CHECK(apart(angles[3], 15) < 0.01);  // nobody painted it: as beside
  read.tones.colours.clear();
  CHECK(apart(read.at({{-5, 0}})[0], 0) < 0.01);
}

TEST_CASE("smoothed edges are no colours, however coarse the picture is") {
  // Red and blue, and their mixture between them, which the list has too.
  const auto picture = [](int x, int) {
    if (x < 10) return Colour{255, 0, 0};
    return x == 10 ? Colour{150, 0, 105} : Colour{0, 0, 255};
  };
  for (const double width : {4.0, 42.0}) {
    Read read = reading(TonesBy::Colours, colourPicture(21, 7, picture), {width, width / 3});
    read.tones.colours = {{"#ff0000", 15}, {"#0000ff", 120}, {"#800080", 60}};
    for (int k = -20; k <= 20; ++k) CHECK(apart(read.at({{width * k / 42.0, 0}})[0], 60) > 30);
  }
}

TEST_CASE("a picture of nothing but edges still has colours") {
  const auto picture = [](int x, int) { return x == 0 ? Colour{200, 30, 30} : Colour{30, 30, 200}; };
  Read read = reading(TonesBy::Colours, colourPicture(2, 1, picture));
  read.tones.colours = {{"#ff0000", 15}, {"#0000ff", 120}};
  CHECK(apart(read.at({{-5, 0}})[0], 15) < 0.01);
  CHECK(apart(read.at({{5, 0}})[0], 120) < 0.01);
}

TEST_CASE("tones and colours keep their directions however the layer is turned") {
  for (const TonesBy by : {TonesBy::Brightness, TonesBy::Levels, TonesBy::Colours}) {
    Read read = reading(by, step());
    read.tones.from = 10;
    read.tones.to = 100;
    read.tones.colours = {{"#000000", 10}, {"#ffffff", 100}};
    read.layer.rotation = 90;
    CHECK(apart(read.at({{0, -15}})[0], 10) < 0.01);
    CHECK(apart(read.at({{0, 15}})[0], 100) < 0.01);
    read.layer.mirror = true;
    CHECK(apart(read.at({{0, -15}})[0], 100) < 0.01);
    CHECK(apart(read.at({{0, 15}})[0], 10) < 0.01);
  }
}

TEST_CASE("pictures of one pixel and boxes thinner than a bead have directions") {
  for (const TonesBy by : {TonesBy::Brightness, TonesBy::Levels, TonesBy::Edges, TonesBy::Colours}) {
    for (const Vec2 box : {Vec2{0.01, 500}, Vec2{3, 0.02}, Vec2{20'000, 1}}) {
      Read read = reading(by, greyPicture(1, 1, [](double, double) { return 1; }), box);
      read.tones.colours = {{"#ffffff", 90}};
      read.tones.smoothing = 100;
      CHECK(apart(read.at({{0, 0}})[0], by == TonesBy::Edges ? 0 : 90) < 0.01);
    }
  }
}
