// A print from above: heights in closed form, and any bytes end in a relief or a sentence.
#include "sillon/rebrush/rebrush.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

using namespace sillon;
using doctest::Approx;

namespace {

// Section 0.4 x 0.2 mm of filament of 1.75 mm, 10 mm long.
constexpr double kPush = 10 * 0.4 * 0.2 / 2.4052818754046854;

std::string bead(double x0, double y0, double x1, double y1, double e) {
  const auto text = [](double value) { return std::to_string(value); };
  return "G1 X" + text(x0) + " Y" + text(y0) + "\nG1 X" + text(x1) + " Y" + text(y1) + " E" + text(e) + "\n";
}

std::string twoLayers() {
  return "G90\nM83\n" + bead(-90, 0, -80, 0, 5) +  // before the first layer: a purge
         ";LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 Z0.2\n" + bead(10, 10, 20, 10, kPush) + bead(60, 10, 70, 10, kPush) +
         ";LAYER_CHANGE\n;Z:0.4\n;HEIGHT:0.2\nG1 Z0.4\n" + bead(10, 10, 10, 20, kPush) +
         bead(20, 10, 30, 20, 2 * kPush);
}

float at(const PrintRelief& relief, double x, double y) {
  const auto column = static_cast<std::size_t>((x - relief.corner.x) / relief.cell);
  const auto row = static_cast<std::size_t>(relief.rows - 1 - static_cast<int>((y - relief.corner.y) / relief.cell));
  return relief.heights[row * static_cast<std::size_t>(relief.columns) + column];
}

}  // namespace

TEST_CASE("beads stand as high as they lie, the highest above the others") {
  const auto made = printRelief(twoLayers(), 512);
  REQUIRE(made);
  const PrintRelief& relief = made.value();
  CHECK(relief.heights.size() == static_cast<std::size_t>(relief.columns) * static_cast<std::size_t>(relief.rows));
  CHECK(std::max(relief.columns, relief.rows) <= 512);
  CHECK(at(relief, 15, 10) == Approx(0.2).epsilon(0.05));
  CHECK(at(relief, 10, 15) == Approx(0.4).epsilon(0.05));
  CHECK(at(relief, 10, 10) == Approx(0.4).epsilon(0.05));  // where both lie
  CHECK(at(relief, 25, 15) == Approx(0.4).epsilon(0.05));  // a diagonal
  CHECK(at(relief, 15, 15) == 0);
  CHECK(at(relief, 15, 10.5) == 0);  // 0.44 mm wide
  CHECK(at(relief, 15, 10.15) > 0.1);
  CHECK(at(relief, 15, 10.15) < at(relief, 15, 10));  // round on top
  // The purge before the first layer is none of the print, and the skirt far beside it is cut off.
  CHECK(relief.corner.x > 0);
  CHECK(relief.corner.x + relief.columns * relief.cell < 40);
}

TEST_CASE("arcs are drawn, and one layer alone is shown whole") {
  const auto made = printRelief(";LAYER_CHANGE\n;HEIGHT:0.2\nM83\nG1 X10 Y0 Z0.2\nG3 X-10 Y0 I-10 J0 E2\n", 256);
  REQUIRE(made);
  CHECK(at(made.value(), 0, 10) == Approx(0.2).epsilon(0.1));
  CHECK(at(made.value(), 0, 3) == 0);
}

TEST_CASE("what is no print is refused in a sentence") {
  CHECK(printRelief("G28\n", 256).error().message.find("the G-code marks no layer") == 0);
  CHECK(printRelief(";LAYER_CHANGE\n", 256).error().message.find("the G-code extrudes nothing") == 0);
  CHECK(printRelief(twoLayers(), 15).error().message.find("side is 15; it must be") == 0);
  const auto far = [](const std::string& x) { return printRelief(";LAYER_CHANGE\nM83\nG1 X" + x + " Y1 E1\n", 256); };
  CHECK(far("20000").error().message.find("10000 mm") != std::string::npos);
  CHECK_FALSE(far(std::string(400, '9')));
}

TEST_CASE("any bytes of a sliced file end in a relief or a sentence") {
  std::ifstream file(SILLON_SOURCE_DIR "/tests/fuzz/seeds/rebrush/prusa.gcode", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  REQUIRE(printRelief(text, 64));
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = text;
    for (int k = 0; k < 30; ++k) damaged[random() % damaged.size()] = "0123456789.-XYZEGIJ\n;"[random() % 21];
    const auto made = printRelief(damaged, 64);
    if (made) CHECK(made.value().columns <= 64);
    if (!made) CHECK_FALSE(made.error().message.empty());
  }
}
