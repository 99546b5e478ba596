// Pictures that tones are read from: decoded, or painted from a drawing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/outline.hpp"
#include "project/files.hpp"
#include "sillon/input/image_io.hpp"

using namespace sillon;

namespace {

ReadInput readerOf(const std::map<std::string, InputFile>& files) {
  return [&files](const std::string& name, const std::string&) -> Result<InputFile> {
    const auto found = files.find(name);
    if (found == files.end()) return Error{ErrorCode::InvalidFile, "no " + name};
    return found->second;
  };
}

}  // namespace

TEST_CASE("a picture file is decoded, whatever its name says") {
  const std::vector<std::uint8_t> png = encodePng(2, 1, std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255});
  const std::map<std::string, InputFile> files{{"colours.svg", std::string(png.begin(), png.end())},
                                               {"grey", Image{1, 1, 1, {300}}}};
  const Result<PaintedFile> colours = readPainted(readerOf(files), "colours.svg", "picture");
  REQUIRE(colours.ok());
  CHECK(colours.value().picture.width == 2);
  CHECK(colours.value().picture.at(0, 0, 0) == 65535);
  CHECK(colours.value().picture.at(1, 0, 2) == 65535);
  CHECK_FALSE(colours.value().drawing.svg);
  CHECK(readPainted(readerOf(files), "grey", "picture").value().picture.samples == std::vector<std::uint16_t>{300});
}

TEST_CASE("a drawing is painted in its colours, its text too") {
  const std::map<std::string, InputFile> files{
      {"letters.svg", std::string("<svg width='200mm' height='100mm' viewBox='0 0 200 100'>"
                                  "<text x='10' y='80' font-size='80' fill='#00f'>Hg</text><image/></svg>")}};
  const Result<PaintedFile> painted = readPainted(readerOf(files), "letters.svg", "picture");
  REQUIRE(painted.ok());
  const Image& image = painted.value().picture;
  CHECK(image.width == 1024);
  CHECK(image.height == 512);
  REQUIRE(image.channels == 4);
  CHECK(painted.value().drawing.images == 1);
  int blue = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool clear = image.at(x, y, 3) == 0;
      REQUIRE((clear || (image.at(x, y, 0) == 0 && image.at(x, y, 1) == 0 && image.at(x, y, 2) == 65535)));
      blue += clear ? 0 : 1;
    }
  }
  const Result<Shape> shape = readDrawing(readerOf(files), "letters.svg", "picture");
  REQUIRE(shape.ok());
  const std::vector<char> inside = insideCells(shape.value(), image.width, image.height);
  CHECK(blue == std::count(inside.begin(), inside.end(), 1));
  CHECK(blue > 20'000);
}

TEST_CASE("a file that cannot be painted is named") {
  const std::map<std::string, InputFile> files{{"broken.svg", std::string("<svg width='1'><rect")},
                                               {"noise.png", std::string("GIF89a")},
                                               {"empty.svg", std::string("<svg width='9' height='9'/>")}};
  for (const char* name : {"broken.svg", "noise.png", "empty.svg", "absent"}) {
    const Result<PaintedFile> painted = readPainted(readerOf(files), name, "picture");
    REQUIRE_FALSE(painted.ok());
    CHECK(painted.error().message.find(name) != std::string::npos);
  }
  CHECK(readPainted(readerOf(files), "empty.svg", "picture").error().code == ErrorCode::EmptyShape);
}
