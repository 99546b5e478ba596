#include "sillon/look/preview.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "look/preview_parts.hpp"
#include "sillon/export/export.hpp"
#include "support/about.hpp"

using namespace sillon;

namespace {

constexpr Rgb kBehind{38, 36, 34};

Rgb pixel(const RgbImage& image, int x, int y) {
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 3;
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

/// Two long beads side by side at `degrees` through the middle of a page of 20 x 20 mm.
Toolpath pairOfBeads(double degrees, double width) {
  const double angle = degrees * std::numbers::pi / 180, half = 8;
  Cycle cycle;
  const auto add = [&](double along, double across) {
    cycle.points.push_back({static_cast<float>(10 + along * std::cos(angle) - across * std::sin(angle)),
                            static_cast<float>(10 + along * std::sin(angle) + across * std::cos(angle))});
    cycle.widths.push_back(static_cast<float>(width));
  };
  add(-half, 0), add(half, 0), add(half, width), add(-half, width);
  return {{cycle}, width};
}

/// Concentric rings, or a wavy stack of rows: something with every direction.
Toolpath rings(Vec2 centre, double radius, double width, int pointsPerRing) {
  Toolpath toolpath{{}, width};
  for (double r = width; r < radius; r += width) {
    Cycle cycle;
    for (int k = 0; k < pointsPerRing; ++k) {
      const double angle = 2 * std::numbers::pi * k / pointsPerRing;
      cycle.points.push_back(
          {static_cast<float>(centre.x + r * std::cos(angle)), static_cast<float>(centre.y + r * std::sin(angle))});
      cycle.widths.push_back(static_cast<float>(width));
    }
    toolpath.cycles.push_back(cycle);
  }
  return toolpath;
}

RgbImage rendered(const Toolpath& toolpath, Vec2 page, int width, int threads = 1) {
  const RunContext run(threads);
  PreviewParams params;
  params.width = width;
  auto image = renderPreview(toolpath, page, params, run);
  REQUIRE(image.ok());
  REQUIRE(image.value().rgb.size() ==
          static_cast<std::size_t>(image.value().width) * static_cast<std::size_t>(image.value().height) * 3);
  return std::move(image).value();
}

std::set<std::tuple<int, int, int>> coloursIn(const RgbImage& image, int y0, int y1, int x0, int x1) {
  std::set<std::tuple<int, int, int>> found;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const Rgb c = pixel(image, x, y);
      found.insert({c.red, c.green, c.blue});
    }
  }
  return found;
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// Every tag closed in the right order, every attribute quoted.
bool wellFormed(const std::string& svg) {
  std::vector<std::string> open;
  std::size_t at = 0;
  while ((at = svg.find('<', at)) != std::string::npos) {
    const std::size_t end = svg.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = svg.substr(at + 1, end - at - 1);
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0 || tag.find('<') != std::string::npos) return false;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name[0] == '/') {
      if (open.empty() || open.back() != name.substr(1)) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty();
}

}  // namespace

TEST_CASE("direction colours are a cycle of 180 degrees in even steps") {
  const auto& colours = directionColours();
  for (std::size_t k = 0; k < colours.size(); ++k) {
    const Rgb a = colours[k], b = colours[(k + 1) % colours.size()];
    const int step = std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
    CHECK(step >= 1);
    CHECK(step <= 14);
  }
  CHECK(directionColourPlace(1, 0) == 0);
  CHECK(directionColourPlace(0, 1) == doctest::Approx(128));
  CHECK(directionColourPlace(0, -1) == doctest::Approx(128));
  CHECK(directionColourPlace(-3, -3) == doctest::Approx(64));
  CHECK(directionColourAt(256) == colours[0]);
  CHECK(directionColourAt(-1) == colours[255]);
}

TEST_CASE("a bead's middle has the colour of its direction, and the legend shows that colour from right to left") {
  int before = 1000;
  for (const double degrees : {1.0, 30.0, 45.0, 90.0, 135.0, 179.0}) {
    CAPTURE(degrees);
    const RgbImage image = rendered(pairOfBeads(degrees, 2), {20, 20}, 560);
    const Rgb expected = directionColourAt(degrees / 180 * kDirectionColours);
    // Margins are a fourteenth of the panel: the page is 480 pixels wide and its middle at 40 + 240.
    CHECK(pixel(image, 280, 280) == expected);
    int best = 1000, column = 0;  // the legend lies below the page, which ends at row 520
    for (int y = 522; y < image.height; ++y) {
      for (int x = 0; x < 560; ++x) {
        const Rgb c = pixel(image, x, y);
        const int error =
            std::abs(c.red - expected.red) + std::abs(c.green - expected.green) + std::abs(c.blue - expected.blue);
        if (error < best) best = error, column = x;
      }
    }
    CHECK(best <= 10);  // pixels of the legend average a few directions
    CHECK(column < before);
    before = column;
  }
}

TEST_CASE("a dark furrow parts neighbouring beads") {
  const RgbImage image = rendered(pairOfBeads(0, 2), {20, 20}, 280);
  const int crest = pixel(image, 140, 140).red, furrow = pixel(image, 140, 140 - 12).red,
            next = pixel(image, 140, 140 - 24).red;
  CHECK(furrow < crest / 2);
  CHECK(next == crest);
}

TEST_CASE("where no bead lies the background stays as it is") {
  const RgbImage image = rendered(pairOfBeads(0, 2), {20, 20}, 280);
  REQUIRE(image.width == 560);
  for (int x = 0; x < 560; ++x) CHECK(pixel(image, x, 0) == kBehind);
  for (int x = 0; x < 280; ++x) {
    CHECK(pixel(image, x, 60) == kBehind);  // within the page
    CHECK(pixel(image, x, 200) == kBehind);
  }
  CHECK(pixel(image, 280 + 20 + 2, 22) == kBehind);       // a corner of the look, far from the shadow
  CHECK(pixel(image, 280 + 140, 153).red < kBehind.red);  // right under the plate, away from the light
}

TEST_CASE("an empty toolpath is an empty page") {
  const RgbImage image = rendered({}, {20, 20}, 100);
  const auto colours = coloursIn(image, 0, 90, 0, image.width);
  CHECK(colours.size() == 1);
}

TEST_CASE("the look depends on the direction of the beads and of the light") {
  const auto brightness = [](double degrees, double azimuth) {
    const RunContext run(1);
    PreviewParams params;
    params.width = 280;
    params.look.lamp.azimuth = azimuth;
    const auto image = renderPreview(pairOfBeads(degrees, 2), {20, 20}, params, run);
    REQUIRE(image.ok());
    return static_cast<int>(pixel(image.value(), 280 + 140, 140).blue);  // of a blue spool
  };
  CHECK(brightness(0, 90) > brightness(90, 90) + 80);  // beads across the light shine
  CHECK(brightness(90, 0) > brightness(0, 0) + 80);
  CHECK(std::abs(brightness(0, 90) - brightness(90, 0)) <= 12);  // and turning both changes little
  CHECK(std::abs(brightness(0, 90) - brightness(180, 90)) <= 2);
  // The lobe is narrow: a few tens of degrees off, most of the highlight is gone. At its best it is not burnt.
  CHECK(brightness(30, 90) < brightness(0, 90) - 40);
  CHECK(brightness(0, 90) > 180);
  CHECK(brightness(0, 90) < 250);
}

TEST_CASE("the picture is the same for any number of threads") {
  const Toolpath toolpath = rings({15, 11}, 10.5, 0.4, 90);
  const RgbImage one = rendered(toolpath, {30, 22}, 300, 1);
  CHECK(one.rgb == rendered(toolpath, {30, 22}, 300, 3).rgb);
  CHECK(one.rgb == rendered(toolpath, {30, 22}, 300, 8).rgb);
}

TEST_CASE("wide pages are stacked, others are side by side") {
  const RgbImage wide = rendered({}, {80, 20}, 200), square = rendered({}, {20, 20}, 200),
                 tall = rendered({}, {20, 60}, 200);
  CHECK(wide.width == 200);
  CHECK(square.width == 400);
  CHECK(tall.width == 400);
}

TEST_CASE("long slanted beads and beads that leave the page are cut, not lost") {
  Cycle cycle;
  cycle.points = {{-50, -50}, {70, 70}, {70, 71}};
  cycle.widths = {1, 1, 1};
  const RgbImage image = rendered({{cycle}, 1}, {20, 20}, 280);
  const Rgb diagonal = directionColourAt(64);
  for (int k = 10; k < 230; ++k) CHECK(pixel(image, 20 + k, 259 - k) == diagonal);
  CHECK(pixel(image, 10, 269) == kBehind);  // the margin stays free
}

TEST_CASE("parameters, pages and toolpaths out of range are errors that name the value's range") {
  const RunContext run(1);
  const auto fails = [&](const Toolpath& toolpath, Vec2 page, PreviewParams params, ErrorCode code) {
    const auto image = renderPreview(toolpath, page, params, run);
    return !image.ok() && image.error().code == code && !image.error().message.empty();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int width : {-1, 0, 15, 16385})
    CHECK(fails({}, {20, 20}, {width, {{60, 35}}}, ErrorCode::InvalidArgument));
  for (const double elevation : {0.0, 91.0, nan})
    CHECK(fails({}, {20, 20}, {100, {{60, elevation}}}, ErrorCode::InvalidArgument));
  CHECK(fails({}, {20, 20}, {100, {{nan, 35}}}, ErrorCode::InvalidArgument));
  for (const Vec2 page : {Vec2{0, 20}, Vec2{20, -1}, Vec2{nan, 20}, Vec2{20, 1e30}}) {
    CHECK(fails({}, page, {100, {{60, 35}}}, ErrorCode::InvalidArgument));
  }
  CHECK(fails({}, {0.01, 1000}, {100, {{60, 35}}}, ErrorCode::TooLarge));
  CHECK(fails({}, {20, 20}, {16384, {{60, 35}}}, ErrorCode::TooLarge));
  Toolpath toolpath = pairOfBeads(0, 2);
  toolpath.cycles[0].points[1].x = std::numeric_limits<float>::quiet_NaN();
  CHECK(fails(toolpath, {20, 20}, {100, {{60, 35}}}, ErrorCode::InvalidArgument));
  toolpath = pairOfBeads(0, 2);
  toolpath.cycles[0].widths[1] = std::numeric_limits<float>::infinity();
  CHECK(fails(toolpath, {20, 20}, {100, {{60, 35}}}, ErrorCode::InvalidArgument));
  toolpath.cycles[0].widths.pop_back();
  CHECK(fails(toolpath, {20, 20}, {100, {{60, 35}}}, ErrorCode::InvalidArgument));
}

TEST_CASE("a cancelled preview says so") {
  RunContext run(1);
  run.requestCancel();
  const auto image = renderPreview(pairOfBeads(0, 2), {20, 20}, {100, {{60, 35}}}, run);
  REQUIRE_FALSE(image.ok());
  CHECK(image.error().code == ErrorCode::Cancelled);
}

TEST_CASE("the smallest panels and degenerate cycles are drawn") {
  CHECK(rendered(rings({10, 10}, 9, 0.4, 30), {20, 20}, 16).width == 32);
  Cycle point;
  point.points = {{5, 5}, {5, 5}, {5, 5}};
  point.widths = {0, 1, 0};
  CHECK(rendered({{point, Cycle{}}, 1}, {20, 20}, 64).width == 128);
}

TEST_CASE("the drawing holds every cycle and is well-formed") {
  const Toolpath toolpath = rings({15, 11}, 10.5, 0.4, 90);
  const std::string svg = toolpathSvg(toolpath, {30, 22.5}).value();
  CHECK(wellFormed(svg));
  CHECK(svg.find("width=\"30mm\" height=\"22.5mm\" viewBox=\"0 0 30 22.5\"") != std::string::npos);
  CHECK(countOf(svg, "<g id=\"cycle") == toolpath.cycles.size());
  CHECK(countOf(svg, "class=\"nozzle\"") == toolpath.cycles.size());
  CHECK(svg.find("<g id=\"cycle" + std::to_string(toolpath.cycles.size()) + "\">") != std::string::npos);
  CHECK(svg == toolpathSvg(toolpath, {30, 22.5}).value());
}

TEST_CASE("the drawing has y down, relative lines exact to a micron, and one stroke per width and direction") {
  Cycle cycle;
  cycle.points = {{1, 2}, {3.5F, 2}, {6, 2}, {6, 4.0625F}, {1, 4.0625F}};
  cycle.widths = {0.4F, 0.405F, 0.4F, 0.4F, 0.4F};
  const std::string svg = toolpathSvg({{cycle}, 0.4}, {10, 8}).value();
  CHECK(countOf(svg, "<path stroke=") == 4);
  CHECK(svg.find("d=\"M1 6l2.5 0l2.5 0\"") != std::string::npos);
  CHECK(svg.find("d=\"M6 6l0-2.062\"") != std::string::npos);  // y = 8 - 4.0625 is 3.938 when rounded
  CHECK(svg.find("d=\"M6 3.938l-5 0\"") != std::string::npos);
  CHECK(svg.find("d=\"M1 6l2.5 0l2.5 0l0-2.062l-5 0z\"") != std::string::npos);
  CHECK(svg.find("stroke-width=\".402\"") != std::string::npos);

  cycle.widths = {0.4F, 0.4F, 0.5F, 0.6F, 0.4F};  // a change of width ends a stroke
  CHECK(countOf(toolpathSvg({{cycle}, 0.4}, {10, 8}).value(), "<path stroke=") == 5);
}

TEST_CASE("relative lines do not drift: the last point of the longest path is where it should be") {
  const Toolpath toolpath = rings({50, 50}, 0.7, 0.4, 20000);
  const std::string svg = toolpathSvg(toolpath, {100, 100}).value();
  const std::size_t nozzle = svg.find("class=\"nozzle\"");
  REQUIRE(nozzle != std::string::npos);
  double x = 0, y = 0;
  std::size_t at = svg.find("d=\"M", nozzle) + 4;
  const auto number = [&] {  // plain decimals as the drawing writes them
    double value = 0, place = 1, sign = 1;
    if (svg[at] == ' ') ++at;
    if (svg[at] == '-') sign = -1, ++at;
    for (; svg[at] >= '0' && svg[at] <= '9'; ++at) value = value * 10 + (svg[at] - '0');
    if (svg[at] == '.') {
      for (++at; svg[at] >= '0' && svg[at] <= '9'; ++at) value += (svg[at] - '0') * (place /= 10);
    }
    return sign * value;
  };
  x = number(), y = number();
  while (svg[at] == 'l') {
    ++at;
    x += number();
    y += number();
  }
  const Vec2f last = toolpath.cycles[0].points.back();
  CHECK(x == about(last.x, 2e-5));
  CHECK(y == about(100 - last.y, 2e-5));
}

TEST_CASE("what is no toolpath is not drawn, and it is said why") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Cycle good{{{0, 0}, {1, 0}, {0, 1}}, {0.4f, 0.4f, 0.4f}};
  const auto refused = [](const Cycle& cycle, Vec2 page) {
    const auto svg = toolpathSvg({{cycle, Cycle{}}, 0.4}, page);
    return !svg.ok() && svg.error().code == ErrorCode::InvalidArgument && svg.error().message.size() > 20;
  };
  CHECK(!refused(good, {10, 8}));
  CHECK(refused({{{nan, 2}, {1, 1}, {2, 2}}, {0.4f, 0.4f, 0.4f}}, {10, 8}));
  CHECK(refused({good.points, {0.4f, 0.4f}}, {10, 8}));
  CHECK(refused({good.points, {0.4f, nan, 0.4f}}, {10, 8}));
  CHECK(refused({good.points, {0.4f, -1, 0.4f}}, {10, 8}));
  CHECK(refused(good, {std::numeric_limits<double>::quiet_NaN(), 8}));
  CHECK(refused(good, {10, -1}));
}

TEST_CASE("the look alone has its size, the plate in its middle, and the same pixels for any number of threads") {
  const Toolpath toolpath{{Cycle{{{5, 5}, {55, 5}, {55, 15}, {5, 15}}, {10, 10, 10, 10}}}, 10};  // fills 60 x 20 mm
  const auto look = renderLook(toolpath, {60, 20}, 120, 90, {}, RunContext(1));
  REQUIRE(look.ok());
  const RgbImage& image = look.value();
  CHECK(image.width == 120);
  CHECK(image.height == 90);
  const auto at = [&](int x, int y) { return &image.rgb[3 * (y * 120 + x)]; };
  const auto plate = [&](int x, int y) { return at(x, y)[2] > 45; };  // the ground is darker
  // 92 % of 120 pixels: from 5 to 115, and a third as high.
  CHECK((plate(60, 45) && plate(8, 45) && plate(112, 45) && plate(60, 29) && plate(60, 60)));
  CHECK_FALSE((plate(2, 45) || plate(117, 45) || plate(60, 15) || plate(60, 75)));
  CHECK(image.rgb == renderLook(toolpath, {60, 20}, 120, 90, {}, RunContext(3)).value().rgb);
  CHECK(
      renderLook(toolpath, {60, 20}, 15, 90, {}, RunContext(1)).error().message.find(" is 15; it must be 16 to 1024") !=
      std::string::npos);
  CHECK(!renderLook(toolpath, {60, 0}, 60, 60, {}, RunContext(1)).ok());
}

// ---- pictures for screens

namespace {

/// Reads QOI by its specification, qoiformat.org. Empty if the bytes are not a whole picture.
std::vector<std::uint8_t> decodeQoi(const std::vector<std::uint8_t>& bytes, int width, int height) {
  const auto number = [&](std::size_t at) {
    return bytes[at] << 24 | bytes[at + 1] << 16 | bytes[at + 2] << 8 | bytes[at + 3];
  };
  if (bytes.size() < 22 || bytes[0] != 'q' || bytes[3] != 'f' || number(4) != width || number(8) != height) return {};
  std::vector<std::uint8_t> rgb;
  const auto wanted = static_cast<std::size_t>(width * height * 3);
  unsigned index[64][4] = {};
  unsigned px[4] = {0, 0, 0, 255};
  std::size_t at = 14;
  while (rgb.size() < wanted && at + 8 < bytes.size()) {
    const unsigned first = bytes[at++];
    unsigned run = 1;
    if (first == 0xFE) {
      for (int k = 0; k < 3; ++k) px[k] = bytes[at++];
    } else if (first >> 6 == 0) {
      for (int k = 0; k < 4; ++k) px[k] = index[first][k];
    } else if (first >> 6 == 1) {
      for (unsigned k = 0; k < 3; ++k) px[k] = (px[k] + (first >> (4 - 2 * k) & 3) - 2) & 255;
    } else if (first >> 6 == 2) {
      const unsigned second = bytes[at++];
      const unsigned green = (first & 63) - 32;
      px[0] = (px[0] + green - 8 + (second >> 4)) & 255;
      px[1] = (px[1] + green) & 255;
      px[2] = (px[2] + green - 8 + (second & 15)) & 255;
    } else {
      run = (first & 63) + 1;
    }
    const unsigned hash = (px[0] * 3 + px[1] * 5 + px[2] * 7 + px[3] * 11) % 64;
    for (int k = 0; k < 4; ++k) index[hash][k] = px[k];
    for (; run > 0; --run) {
      for (int k = 0; k < 3; ++k) rgb.push_back(static_cast<std::uint8_t>(px[k]));
    }
  }
  const std::vector<std::uint8_t> end{0, 0, 0, 0, 0, 0, 0, 1};
  const bool ended = at + 8 == bytes.size() && std::equal(end.begin(), end.end(), bytes.end() - 8);
  return ended ? rgb : std::vector<std::uint8_t>();
}

}  // namespace

TEST_CASE("QOI pictures are read back by their specification: runs, steps, repeats, noise") {
  const std::vector<std::uint8_t> pixel = encodeQoi(1, 1, std::vector<std::uint8_t>{10, 20, 30});
  CHECK(pixel == std::vector<std::uint8_t>{'q', 'o',  'i', 'f', 0,  0, 0, 1, 0, 0, 0, 1, 3,
                                           0,   0xFE, 10,  20,  30, 0, 0, 0, 0, 0, 0, 0, 1});
  std::vector<std::uint8_t> rgb(3 * 100 * 40);
  unsigned state = 1;
  for (std::size_t k = 0; k < rgb.size(); ++k) {
    state = state * 1664525u + 1013904223u;
    const std::size_t row = k / 300;
    const unsigned noise = state >> 24;
    const std::size_t x = k % 300 / 3;
    rgb[k] = static_cast<std::uint8_t>(row < 10 ? 0 : row < 20 ? x + k % 3 : row < 30 ? (x / 3 % 4) * 60 : noise);
  }
  const std::vector<std::uint8_t> coded = encodeQoi(100, 40, rgb);
  CHECK(decodeQoi(coded, 100, 40) == rgb);
  CHECK(coded.size() < rgb.size() / 2);
}

TEST_CASE("pictures of the same proportions are means of the largest") {
  const Toolpath toolpath = rings({10, 10}, 9, 0.4, 64);
  const auto pictures = lookThumbnails(toolpath, {20, 20}, "32x32/QOI, 96x96/QOI, 64x64/QOI", {}, RunContext(1));
  REQUIRE(pictures);
  const std::vector<std::uint8_t> large = decodeQoi(pictures.value()[1].bytes, 96, 96);
  CHECK(large == renderLook(toolpath, {20, 20}, 96, 96, {}, RunContext(1)).value().rgb);
  CHECK(decodeQoi(pictures.value()[2].bytes, 64, 64) ==
        renderLook(toolpath, {20, 20}, 64, 64, {}, RunContext(1)).value().rgb);  // too large to be sharp
  const std::vector<std::uint8_t> small = decodeQoi(pictures.value()[0].bytes, 32, 32);
  for (std::size_t k = 0; k < small.size(); ++k) {
    const std::size_t x = k / 3 % 32, y = k / 96;
    int sum = 0;
    for (std::size_t v = 3 * y; v < 3 * y + 3; ++v) {
      for (std::size_t u = 3 * x; u < 3 * x + 3; ++u) sum += large[(v * 96 + u) * 3 + k % 3];
    }
    CHECK(std::abs(9 * small[k] - sum) <= 5);
  }
  // Pixels of the largest that reach into several of the smaller one: what is one colour stays it.
  const auto uneven = lookThumbnails(toolpath, {20, 20}, "32x32/QOI, 300x300/QOI", {}, RunContext(1));
  REQUIRE(uneven);
  const std::vector<std::uint8_t> corner = decodeQoi(uneven.value()[0].bytes, 32, 32);
  CHECK(std::vector<std::uint8_t>(corner.begin(), corner.begin() + 3) ==
        std::vector<std::uint8_t>{kBehind.red, kBehind.green, kBehind.blue});
}

TEST_CASE("pictures come in the sizes and formats a printer asks for") {
  const Toolpath toolpath = pairOfBeads(30, 0.4);
  const auto pictures = lookThumbnails(toolpath, {20, 20}, "16x24/QOI, 40x30/PNG,32x32", {}, RunContext(1));
  REQUIRE(pictures);
  REQUIRE(pictures.value().size() == 3);
  const Thumbnail& qoi = pictures.value()[0];
  CHECK((qoi.format == ThumbnailFormat::Qoi && qoi.width == 16 && qoi.height == 24));
  CHECK(decodeQoi(qoi.bytes, 16, 24) == renderLook(toolpath, {20, 20}, 16, 24, {}, RunContext(1)).value().rgb);
  CHECK((pictures.value()[1].width == 40 && pictures.value()[1].bytes[1] == 'P'));
  CHECK(pictures.value()[2].format == ThumbnailFormat::Png);
  CHECK(readThumbnailSizes("").value().empty());
  for (const char* bad : {"32", "32x", "x32", "8x8", "32x2000", "32x32/JPG", "32x32x32", ",", "32x32,", "-16x16"}) {
    CAPTURE(bad);
    CHECK(readThumbnailSizes(bad).ok() == (std::string(bad) == "32x32,"));  // a last comma does no harm
  }
}
