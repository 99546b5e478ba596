// Drawings in their colours: which paint each path has, and what the page looks like.
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "input/svg.hpp"

using namespace sillon;

namespace {

// A document with one user unit per mm.
std::string page(const std::string& body, int width = 100, int height = 100) {
  const std::string size = std::to_string(width) + "mm\" height=\"" + std::to_string(height) + "mm\" viewBox=\"0 0 " +
                           std::to_string(width) + " " + std::to_string(height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\">" + body + "</svg>";
}

SvgPainting read(const std::string& text) {
  Result<SvgPainting> painting = readSvgPainting(text);
  REQUIRE_MESSAGE(painting.ok(), (painting.ok() ? "" : painting.error().message));
  REQUIRE(painting.value().paints.size() == painting.value().shape.paths.size());
  return std::move(painting).value();
}

using Pixel = std::array<int, 4>;

Pixel at(const Image& image, int x, int y) {
  return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2), image.at(x, y, 3)};
}

}  // namespace

TEST_CASE("paths have the colours of their fills, in whatever words they are written") {
  const std::pair<std::string_view, std::uint32_t> all[] = {{"red", 0xff0000},
                                                            {"Teal", 0x008080},
                                                            {"rebeccapurple", 0x663399},
                                                            {"darkslategrey", 0x2f4f4f},
                                                            {"yellowgreen", 0x9acd32},
                                                            {"aliceblue", 0xf0f8ff},
                                                            {"canvas", 0xffffff},
                                                            {"currentColor", 0x00ff00},
                                                            {"#f80", 0xff8800},
                                                            {"#1A2b3c80", 0x1a2b3c},
                                                            {"rgb(26, 43, 60)", 0x1a2b3c},
                                                            {"rgb(100% 50% 0%)", 0xff8000},
                                                            {"hsl(120 100% 25%)", 0x008000},
                                                            {"hsl(240, 100%, 50%)", 0x0000ff},
                                                            {"hsl(30 100% 50%)", 0xff8000},
                                                            {"hsl(-90 100% 50%)", 0x8000ff},
                                                            {"hsl(77 0% 20%)", 0x333333},
                                                            {"url(#mixed)", 0x800080}};
  for (const auto& [word, colour] : all) {
    const std::string_view captured = word;  // clang 14 captures no structured binding
    CAPTURE(captured);
    const SvgPainting painting =
        read(page("<linearGradient id='mixed'><stop stop-color='red'/><stop stop-color='blue'/></linearGradient>"
                  "<rect width='9' height='9' color='lime' fill='" +
                  std::string(word) + "'/>"));
    REQUIRE(painting.paints.size() == 1);
    CHECK(painting.paints[0].colour == colour);
  }
}

TEST_CASE("strokes lie over fills, each in its colour and as opaque as it is") {
  const SvgPainting painting =
      read(page("<g opacity='.5'><rect x='10' y='10' width='20' height='20' fill='red' stroke='blue' "
                "stroke-opacity='.5' stroke-width='2'/></g><path d='M50 50h9v9z'/>"));
  REQUIRE(painting.paints.size() == 3);
  CHECK(painting.paints[0].colour == 0xff0000);
  CHECK(painting.paints[0].alpha == doctest::Approx(0.5));
  CHECK(painting.paints[1].colour == 0x0000ff);
  CHECK(painting.paints[1].alpha == doctest::Approx(0.25));
  CHECK(painting.paints[2].colour == 0);
  CHECK(painting.paints[2].alpha == 1);
}

TEST_CASE("a drawing is painted with hard edges, later paths on top, and clear elsewhere") {
  const Image image =
      paintedPicture(read(page("<rect x='10' y='20' width='30' height='40' fill='red'/>"
                               "<rect x='30' y='20' width='30' height='40' fill='#00f'/>"
                               "<rect x='10' y='50' width='80' height='10' fill='white' opacity='.5'/>")),
                     100);
  REQUIRE(image.width == 100);
  REQUIRE(image.height == 100);
  REQUIRE(image.channels == 4);
  constexpr int kFull = 65535, kHalf = 32768;
  CHECK(at(image, 9, 30) == Pixel{0, 0, 0, 0});
  CHECK(at(image, 10, 20) == Pixel{kFull, 0, 0, kFull});
  CHECK(at(image, 10, 19) == Pixel{0, 0, 0, 0});
  CHECK(at(image, 29, 49) == Pixel{kFull, 0, 0, kFull});
  CHECK(at(image, 30, 49) == Pixel{0, 0, kFull, kFull});
  CHECK(at(image, 59, 20) == Pixel{0, 0, kFull, kFull});
  CHECK(at(image, 60, 20) == Pixel{0, 0, 0, 0});
  CHECK(at(image, 20, 55) == Pixel{kFull, kHalf, kHalf, kFull});
  CHECK(at(image, 50, 55) == Pixel{kHalf, kHalf, kFull, kFull});
  CHECK(at(image, 80, 55) == Pixel{kFull, kFull, kFull, kHalf});
  CHECK(at(image, 80, 60) == Pixel{0, 0, 0, 0});
}

TEST_CASE("the longer side has as many pixels as are asked for, and the other one follows") {
  const std::string body = "<rect width='9' height='9'/>";
  const Image wide = paintedPicture(read(page(body, 200, 100)), 1024);
  CHECK(wide.width == 1024);
  CHECK(wide.height == 512);
  const Image tall = paintedPicture(read(page(body, 1, 4000)), 1024);
  CHECK(tall.width == 1);
  CHECK(tall.height == 1024);
}

TEST_CASE("drawings that would take long to paint have fewer pixels") {
  std::string areas;
  for (int k = 0; k < 2000; ++k) areas += "<rect width='100' height='100' fill='#" + std::to_string(1000 + k) + "00'/>";
  const Image covered = paintedPicture(read(page(areas)), 1024);
  CHECK(covered.width == 316);  // 2000 times as many are 2e8
  CHECK(at(covered, 50, 50)[3] == 65535);
  std::string line = "M0 0";
  for (int k = 0; k < 200'000; ++k)
    line += "V100H" + std::to_string((2 * k + 1) % 100) + "V0H" + std::to_string((2 * k + 2) % 100);
  const Image crossed = paintedPicture(read(page("<path d='" + line + "'/>")), 1024);
  CHECK(crossed.height == 50);  // 400000 lines cross as many rows 2e7 times
}
