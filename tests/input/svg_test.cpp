#include "input/svg.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "geometry/outline.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using scenes::shoelace;

namespace {

// Sum of |area| over all rings.
double ringArea(const Shape& shape) {
  double sum = 0;
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) sum += std::abs(shoelace(ring));
  }
  return sum;
}

std::size_t ringCount(const Shape& shape) {
  std::size_t count = 0;
  for (const FilledPath& path : shape.paths) count += path.rings.size();
  return count;
}

// A document of 100 x 100 mm with one user unit per mm.
std::string page(const std::string& body, const std::string& attributes = "") {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"100mm\" "
         "height=\"100mm\" viewBox=\"0 0 100 100\" " +
         attributes + ">" + body + "</svg>";
}

// A polygon inside a curve loses at most two thirds of the tolerance times the length of the curve; outside it gains.
void checkArea(const Shape& shape, double expected, double curveLength) {
  CHECK(std::abs(ringArea(shape) - expected) <= 1e-6 * expected + 0.00134 * curveLength);
}

Shape read(const std::string& text, const SvgOptions& options = {}) {
  const Result<Shape> shape = readSvg(text, options);
  INFO(text.substr(0, 400));
  if (!shape.ok()) FAIL(shape.error().message);
  return shape.value();
}

// Where a test is about where outlines lie, be it off the page.
const SvgOptions kOutlines{.ignorePaint = true};

Shape readPath(const std::string& d) { return read(page("<path d=\"" + d + "\"/>")); }

// Bounds as left, bottom, right, top.
void checkBounds(const Shape& shape, double left, double bottom, double right, double top, double tolerance = 1e-6) {
  const Bounds box = bounds(shape);
  CHECK(std::abs(box.min.x - left) <= tolerance);
  CHECK(std::abs(box.min.y - bottom) <= tolerance);
  CHECK(std::abs(box.max.x - right) <= tolerance);
  CHECK(std::abs(box.max.y - top) <= tolerance);
  INFO("bounds ", box.min.x, " ", box.min.y, " ", box.max.x, " ", box.max.y);
  CHECK_FALSE(box.empty());
}

void checkRefused(const std::string& text, ErrorCode code, const std::vector<std::string>& words) {
  const Result<Shape> shape = readSvg(text);
  INFO(text.substr(0, 300));
  REQUIRE_FALSE(shape.ok());
  INFO(shape.error().message);
  CHECK(shape.error().code == code);
  for (const std::string& word : words) {
    INFO("the message must hold: ", word);
    CHECK(shape.error().message.find(word) != std::string::npos);
  }
}

Vec2 pageOf(const std::string& rootAttributes, const SvgOptions& options = {}) {
  SvgOptions outlines = options;
  outlines.ignorePaint = true;  // the viewBox may show another place
  return read("<svg " + rootAttributes + "><rect width=\"1\" height=\"1\"/></svg>", outlines).page;
}

}  // namespace

TEST_CASE("a rectangle lands where it is drawn, y up, with exact corners") {
  const Shape shape = read(page("<rect x=\"10\" y=\"20\" width=\"30\" height=\"40\"/>"));
  CHECK(shape.page == Vec2{100, 100});
  REQUIRE(ringCount(shape) == 1);
  const Ring& ring = shape.paths[0].rings[0];
  REQUIRE(ring.size() == 4);
  CHECK(ring[0] == Vec2{10, 80});
  CHECK(ring[2] == Vec2{40, 40});
  CHECK(ringArea(shape) == doctest::Approx(1200));
}

TEST_CASE("straight path commands work absolute, relative and repeated") {
  const double expected = 600;
  for (const char* d :
       {"M10 10 L40 10 L40 30 L10 30 Z", "M10,10 40,10 40,30 10,30", "m10 10 30 0 0 20 -30 0z", "M10 10H40V30H10Z",
        "m10 10h30v20h-30z", "m10 10h10 20v5 15h-30z", "M10 10l30 0l0 20L10 30", "M10-10m0,20h30v20h-30",
        "M+10+10L4e1 1.e1 40,30.0 .1E2 30z", "M 1e1 10 40 10 40 30 10 30 Z M 0 0"}) {
    CAPTURE(std::string(d));
    const Shape shape = readPath(d);
    CHECK(ringCount(shape) == 1);
    CHECK(ringArea(shape) == doctest::Approx(expected));
    checkBounds(shape, 10, 70, 40, 90);
  }
}

TEST_CASE("after Z drawing goes on from the start of the part") {
  // Second part: relative to (10, 10) again, without M.
  const Shape shape = readPath("M10 10h10v10h-10z l-5 0 0 -5z");
  REQUIRE(ringCount(shape) == 2);
  CHECK(ringArea(shape) == doctest::Approx(100 + 12.5));
  checkBounds(shape, 5, 80, 20, 95);
}

TEST_CASE("cubic and quadratic curves have the areas calculus gives") {
  // Control polygon (0,0) (0,40) (60,40) (60,0), symmetric: y(t) = 120 t (1-t), x'(t) = 360 t (1-t), area 43200 / 30.
  for (const char* d : {"M20 20C20 60 80 60 80 20Z", "m20 20c0 40 60 40 60 0z", "M20 20C20 60 80 60 80 20"}) {
    CAPTURE(std::string(d));
    const Shape shape = readPath(d);
    checkArea(shape, 1440, 100);
    checkBounds(shape, 20, 50, 80, 80, 0.002);
  }
  for (const char* d : {"M20 20Q50 80 80 20Z", "m20 20q30 60 60 0z"}) {
    CAPTURE(std::string(d));
    const Shape shape = readPath(d);
    checkArea(shape, 60 * 60 / 2 * 2.0 / 3, 90);
    checkBounds(shape, 20, 50, 80, 80, 0.002);
  }
}

TEST_CASE("smooth curves continue with the mirrored control point, and only after a curve of their kind") {
  const auto same = [](const char* smooth, const char* full) {
    CAPTURE(std::string(smooth));
    const Shape a = readPath(smooth), b = readPath(full);
    REQUIRE(ringCount(a) == 1);
    REQUIRE(ringCount(b) == 1);
    CHECK(a.paths[0].rings[0] == b.paths[0].rings[0]);
  };
  same("M10 50C10 20 40 20 40 50S70 80 70 50z", "M10 50C10 20 40 20 40 50C40 80 70 80 70 50z");
  same("M10 50c0 -30 30 -30 30 0s30 30 30 0z", "M10 50C10 20 40 20 40 50C40 80 70 80 70 50z");
  same("M10 50S40 20 40 60z", "M10 50C10 50 40 20 40 60z");
  same("M10 50Q40 20 40 50T70 90z", "M10 50Q40 20 40 50Q40 80 70 90z");
  same("M10 50q30 -30 30 0t30 40z", "M10 50Q40 20 40 50Q40 80 70 90z");
  same("M10 50Q40 20 40 50T70 90 90 10z", "M10 50Q40 20 40 50Q40 80 70 90Q100 100 90 10z");
  same("M10 50C10 20 40 20 40 50T70 80L70 20z", "M10 50C10 20 40 20 40 50Q40 50 70 80L70 20z");
}

TEST_CASE("arcs of all four kinds have the areas of their segments") {
  // Chord from (50,40) to (60,50) on circles of radius 10: centres (50,50) and (60,40).
  const double quarter = std::numbers::pi * 100 / 4 - 50;  // segment between chord and quarter arc
  const double rest = std::numbers::pi * 100 - quarter;
  const std::array<std::pair<const char*, double>, 4> cases{{{"M50 40A10 10 0 0 1 60 50Z", quarter},
                                                             {"M50 40A10 10 0 0 0 60 50Z", quarter},
                                                             {"M50 40A10 10 0 1 1 60 50Z", rest},
                                                             {"M50 40A10 10 0 1 0 60 50Z", rest}}};
  for (const auto& item : cases) {
    const std::string d = item.first;
    const double area = item.second;
    CAPTURE(d);
    checkArea(readPath(d), area, area == rest ? 15 * std::numbers::pi : 5 * std::numbers::pi);
  }
  checkBounds(readPath("M50 40A10 10 0 1 1 60 50Z"), 50, 50, 70, 70, 0.002);  // centre (60, 40)
  checkBounds(readPath("M50 40A10 10 0 1 0 60 50Z"), 40, 40, 60, 60, 0.002);  // centre (50, 50)
}

TEST_CASE("arcs take packed flags, turned axes, too small radii and radii of zero") {
  checkArea(readPath("m40 50a10 10 0 0120 0a10 10 0 01-20 0z"), std::numbers::pi * 100, 2 * std::numbers::pi * 10);
  checkArea(readPath("M40 50a10-10 0 1 1 20 0 10 10 0 1 1-20 0"), std::numbers::pi * 100, 2 * std::numbers::pi * 10);
  // Too small by half: grown to the half circle of radius 10.
  checkBounds(readPath("M40 50A5 5 0 0 1 60 50Z"), 40, 50, 60, 60, 0.002);
  // An ellipse of 20 x 10 turned by 90 degrees: 20 high.
  checkBounds(readPath("M40 50A20 10 90 0 1 60 50A20 10 90 0 1 40 50Z"), 40, 30, 60, 70, 0.002);
  // Turned by 30: half extents sqrt(a² cos² + b² sin²).
  const double x = std::sqrt(400 * 0.75 + 100 * 0.25), y = std::sqrt(400 * 0.25 + 100 * 0.75);
  const double c = std::sqrt(0.75) * 20, s = 0.5 * 20;  // ends of the long axis
  const auto number = [](double v) { return std::to_string(v); };
  checkBounds(readPath(std::string("M") + number(50 + c) + " " + number(50 + s) + "A20 10 30 1 1 " + number(50 - c) +
                       " " + number(50 - s) + "A20 10 30 1 1 " + number(50 + c) + " " + number(50 + s) + "z"),
              50 - x, 50 - y, 50 + x, 50 + y, 0.003);
  CHECK(ringArea(readPath("M40 50A0 10 0 0 1 60 50L60 60z")) == doctest::Approx(100));
  CHECK(ringArea(readPath("M40 50A10 10 0 0 1 40 50L60 50L60 60z")) == doctest::Approx(100));
  CHECK(ringArea(readPath("M40 50A1e12 1e12 0 0 1 60 50L60 60z")) == doctest::Approx(100));
}

TEST_CASE("curves stay within the tolerance, and a finer one costs more points") {
  std::size_t coarse = 0, fine = 0;
  for (const double tolerance : {0.1, 0.002, 0.0002}) {
    const Shape shape =
        read(page("<g transform=\"translate(10 0) scale(3 0.5)\"><circle cx=\"15\" cy=\"100\" r=\"13\"/></g>"),
             {.tolerance = tolerance});
    const Ring& ring = shape.paths.at(0).rings.at(0);
    const Vec2 center{55, 50}, radii{39, 6.5};
    double worst = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      const auto relative = [&](Vec2 p) {
        return length(Vec2{(p.x - center.x) / radii.x, (p.y - center.y) / radii.y});
      };
      CHECK(relative(a) == doctest::Approx(1).epsilon(1e-6));
      // Distance of the chord's middle, over-estimated by the long axis where it is steep: use the gradient.
      const Vec2 m = 0.5 * (a + b) - center;
      const Vec2 gradient{m.x / (radii.x * radii.x), m.y / (radii.y * radii.y)};
      const double value = (dot(m, gradient) - 1) / 2;
      worst = std::max(worst, std::abs(value) / length(gradient));
    }
    CHECK(worst <= tolerance * 1.01 + 1e-6);
    if (tolerance == 0.1) coarse = ring.size();
    if (tolerance == 0.0002) fine = ring.size();
  }
  CHECK(fine > 10 * coarse);

  // A cubic with a tight bend: its polygon at 0.0001 mm lies within 0.01 mm of that at 0.01 mm.
  const std::string bend = page("<path d=\"M10 10C90 10 5 90 90 90L90 95L5 95z\"/>");
  const Ring exact = read(bend, {.tolerance = 1e-4}).paths[0].rings[0];
  const Ring rough = read(bend, {.tolerance = 1e-2}).paths[0].rings[0];
  CHECK(rough.size() < exact.size());
  for (const Vec2 p : exact) {
    double best = 1e9;
    for (std::size_t i = 0; i < rough.size(); ++i) {
      const Vec2 a = rough[i], d = rough[(i + 1) % rough.size()] - a;
      const double t = std::min(1.0, std::max(0.0, dot(p - a, d) / dot(d, d)));
      best = std::min(best, length(p - a - t * d));
    }
    REQUIRE(best <= 0.0101);
  }
}

TEST_CASE("a drawing in small units is as smooth at the width asked for as any other") {
  SvgOptions options;
  options.width = 100;
  const Shape disc = read("<svg viewBox='0 0 1 2'><circle cx='.5' cy='.5' r='.5'/></svg>", options);
  CHECK(disc.page == Vec2{100, 200});
  CHECK(std::abs(ringArea(disc) / (std::numbers::pi * 2500) - 1) < 1e-4);
  const Shape line = read("<svg width='20mm' height='20mm'><path d='M0 9h9' stroke='red' stroke-width='2mm'/></svg>",
                          options);  // five times as long and as wide
  CHECK(ringArea(line) == doctest::Approx(9 * 25.4 / 96 * 5 * 10));
  CHECK(read("<svg viewBox='0 0 9 9'><rect x='3' width='9' height='3'/></svg>", options).drawing.offPage ==
        doctest::Approx(10000.0 / 9));
  for (const double width : {-1.0, 1e-7, 1.1e5, std::numeric_limits<double>::quiet_NaN()}) {
    options.width = width;
    CHECK(readSvg("<svg viewBox='0 0 1 1'/>", options).error().code == ErrorCode::InvalidArgument);
  }
  options.width = 1e5;
  CHECK(readSvg("<svg viewBox='0 0 1 9'/>", options).error().code == ErrorCode::TooLarge);
}

TEST_CASE("circles and ellipses touch their extremes exactly") {
  const Shape circle = read(page("<circle cx=\"50\" cy=\"40\" r=\"20\"/>"));
  checkBounds(circle, 30, 40, 70, 80, 0);
  checkArea(circle, std::numbers::pi * 400, 2 * std::numbers::pi * 20);
  const Shape ellipse = read(page("<ellipse cx=\"50\" cy=\"50\" rx=\"40\" ry=\"5\"/>"));
  checkBounds(ellipse, 10, 45, 90, 55, 0);
  checkArea(ellipse, std::numbers::pi * 200, 2 * std::numbers::pi * 26);
  checkArea(read(page("<ellipse cx=\"50\" cy=\"50\" rx=\"10\"/>")), std::numbers::pi * 100, 2 * std::numbers::pi * 10);
}

TEST_CASE("rounded rectangles: one radius counts for both, radii end at half the side") {
  const auto rounded = [](const std::string& radii) {
    return read(page("<rect x=\"10\" y=\"10\" width=\"60\" height=\"40\" " + radii + "/>"));
  };
  const auto expected = [](double rx, double ry) { return 2400 - (4 - std::numbers::pi) * rx * ry; };
  checkArea(rounded("rx=\"5\""), expected(5, 5), std::numbers::pi * (5 + 5));
  checkArea(rounded("ry=\"5\""), expected(5, 5), std::numbers::pi * (5 + 5));
  checkArea(rounded("rx=\"10\" ry=\"4\""), expected(10, 4), std::numbers::pi * (10 + 4));
  checkArea(rounded("rx=\"auto\" ry=\"4\""), expected(4, 4), std::numbers::pi * (4 + 4));
  checkArea(rounded("rx=\"99\""), expected(30, 20), std::numbers::pi * (30 + 20));
  checkArea(rounded("rx=\"0\" ry=\"9\""), 2400, 0);
  checkBounds(read(page("<rect x=\"10\" y=\"10\" width=\"60\" height=\"40\" rx=\"99\"/>")), 10, 50, 70, 90, 0);
}

TEST_CASE("polygons and polylines are closed; lines, text and images are not shapes") {
  const std::string points = "points=\"10,10 40,10 40,30\n 10 30\"/>";
  CHECK(ringArea(read(page("<polygon " + points))) == doctest::Approx(600));
  CHECK(ringArea(read(page("<polyline fill=\"none\" " + points))) == doctest::Approx(600));
  CHECK(ringCount(read(page("<line x1=\"0\" y1=\"0\" x2=\"9\" y2=\"9\"/><text>a</text><image width=\"9\" height=\"9\"/>"
                            "<polygon " +
                            points))) == 1);
}

TEST_CASE("where paint is ignored, or nothing is painted, outlines are the shape") {
  CHECK(ringArea(read(page("<path style=\"fill:none;stroke:#000\" d=\"M10 10h10v10h-10z\"/>"), kOutlines)) ==
        doctest::Approx(100));
  checkArea(read(page("<g fill=\"none\"><circle cx=\"50\" cy=\"50\" r=\"10\" fill=\"none\"/></g>")),
            std::numbers::pi * 100, 2 * std::numbers::pi * 10);
}

TEST_CASE("transforms nest, and each kind moves points as SVG says") {
  const auto box = [](const std::string& transform, double left, double top, double right, double bottom) {
    CAPTURE(transform);
    checkBounds(
        read(page("<rect transform=\"" + transform + "\" x=\"10\" y=\"10\" width=\"20\" height=\"10\"/>"), kOutlines),
        left, 100 - bottom, right, 100 - top, 1e-6);
  };
  box("none", 10, 10, 30, 20);
  box("", 10, 10, 30, 20);
  box("translate(5)", 15, 10, 35, 20);
  box("translate(5,7)", 15, 17, 35, 27);
  box("scale(2)", 20, 20, 60, 40);
  box("scale(2 -1)", 20, -20, 60, -10);
  box("rotate(90)", -20, 10, -10, 30);
  box("rotate(90 10 10)", 0, 10, 10, 30);
  box("skewX(45)", 20, 10, 50, 20);
  box("skewY(45)", 10, 20, 30, 50);
  box("matrix(0 1 2 0 3 4)", 23, 14, 43, 34);
  box(" translate(10 0) , scale(2)rotate(90) ", -30, 20, -10, 60);
  const Shape nested =
      read(page("<g transform=\"translate(10 0)\"><a transform=\"scale(2)\"><g transform=\"rotate(90)\">"
                "<rect x=\"10\" y=\"10\" width=\"20\" height=\"10\"/></g></a></g>"),
           kOutlines);
  checkBounds(nested, -30, 40, -10, 80);
}

TEST_CASE("viewBox scales and moves the drawing into the page for every alignment") {
  // A box of 50 x 25 from (-5, 10) in a page of 80 x 80: meet scales by 1.6 to 80 x 40, slice by 3.2 to 160 x 80.
  const auto corner = [](const std::string& ratio) {
    const Shape shape = read("<svg width=\"80mm\" height=\"80mm\" viewBox=\"-5,10 50 25\" " + ratio +
                                 "><rect x=\"-5\" y=\"10\" width=\"50\" height=\"25\"/></svg>",
                             kOutlines);
    const Bounds box = bounds(shape);
    return std::array<double, 4>{box.min.x, 80 - box.max.y, box.size().x, box.size().y};
  };
  const auto check = [&](const std::string& value, double x, double y, double width, double height) {
    CAPTURE(value);
    const auto box = corner(value.empty() ? "" : "preserveAspectRatio=\"" + value + "\"");
    CHECK(box[0] == doctest::Approx(x));
    CHECK(box[1] == doctest::Approx(y));
    CHECK(box[2] == doctest::Approx(width));
    CHECK(box[3] == doctest::Approx(height));
  };
  check("", 0, 20, 80, 40);
  check("none", 0, 0, 80, 80);
  const std::array<const char*, 3> names{"Min", "Mid", "Max"};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const std::string align = std::string("x") + names[i] + "Y" + names[j];
      check(align, 0, 20 * j, 80, 40);
      check(align + " meet", 0, 20 * j, 80, 40);
      check(align + " slice", -40 * i, 0, 160, 80);
    }
  }
  check("defer xMinYMax slice", 0, 0, 160, 80);
}

TEST_CASE("the page is the root's size in every unit") {
  const double px = 25.4 / 96;
  const std::array<std::pair<const char*, double>, 12> units{{{"mm", 1},
                                                              {"cm", 10},
                                                              {"in", 25.4},
                                                              {"pt", 25.4 / 72},
                                                              {"pc", 25.4 / 6},
                                                              {"px", px},
                                                              {"Q", 0.25},
                                                              {"", px},
                                                              {"MM", 1},
                                                              {"em", 16 * px},
                                                              {"ex", 8 * px},
                                                              {"q", 0.25}}};
  for (const auto& item : units) {
    const std::string unit = item.first;
    const double mm = item.second;
    CAPTURE(unit);
    const Vec2 size = pageOf("width=\"20" + unit + "\" height=\" 1e1" + unit + " \"");
    CHECK(size.x == doctest::Approx(20 * mm).epsilon(1e-7));
    CHECK(size.y == doctest::Approx(10 * mm).epsilon(1e-7));
  }
  SvgOptions mm;
  mm.unitlessIsMm = true;
  CHECK(pageOf("width=\"20\" height=\"10\"", mm) == Vec2{20, 10});
  CHECK(pageOf("width=\"96px\" height=\"1in\"", mm) == Vec2{25.4, 25.4});
}

TEST_CASE("without width and height, or in percent, the page is the viewBox; one side follows from the other") {
  const Vec2 expected{96 * 25.4 / 96, 48 * 25.4 / 96};
  for (const char* attributes : {"viewBox=\"0 0 96 48\"", "viewBox=\"0 0 96 48\" width=\"100%\" height=\"100%\"",
                                 "viewBox=\"0 0 96 48\" width=\"auto\"", "viewBox=\"9 9 96 48\" width=\"1in\"",
                                 "viewBox=\"0 0 9.6 4.8\" height=\"12.7mm\" width=\"50%\""}) {
    CAPTURE(std::string(attributes));
    const Vec2 size = pageOf(attributes);
    CHECK(size.x == doctest::Approx(expected.x));
    CHECK(size.y == doctest::Approx(expected.y));
  }
  SvgOptions mm;
  mm.unitlessIsMm = true;
  CHECK(pageOf("viewBox=\"0 0 96 48\"", mm) == Vec2{96, 48});
}

TEST_CASE("lengths of shapes take units and percentages of the nearest viewport") {
  // No viewBox: user units are px.
  checkBounds(
      read("<svg width=\"100mm\" height=\"50mm\"><rect x=\"1cm\" y=\"10%\" width=\"50%\" height=\"96\"/></svg>"), 10,
      50 - 5 - 25.4, 60, 45);
  // With mm for numbers without unit, px stays px.
  checkBounds(read("<svg width=\"100\" height=\"50\"><rect x=\"10\" y=\"10%\" width=\"50%\" height=\"96px\"/></svg>",
                   {.unitlessIsMm = true}),
              10, 50 - 5 - 25.4, 60, 45);
  // viewBox of 200 x 100 in 100 x 50 mm: percentages of the box.
  const std::string box = "<svg width=\"100mm\" height=\"50mm\" viewBox=\"0 0 200 100\">";
  checkBounds(read(box + "<rect x=\"10%\" y=\"10%\" width=\"50%\" height=\"50%\"/></svg>"), 10, 20, 60, 45);
  const double r = 0.1 * std::sqrt((200.0 * 200 + 100 * 100) / 2) / 2;  // of the diagonal / sqrt 2
  checkBounds(read(box + "<circle cx=\"50%\" cy=\"50%\" r=\"10%\"/></svg>"), 50 - r, 25 - r, 50 + r, 25 + r);
  checkBounds(read(box + "<ellipse cx=\"50%\" cy=\"50%\" rx=\"10%\" ry=\"20%\"/></svg>"), 40, 15, 60, 35);
}

TEST_CASE("fill rules come from attributes, styles, style sheets and parents") {
  const auto rule = [](const std::string& body) { return read(page(body)).paths.at(0).fillRule; };
  const std::string d = " d=\"M10 10h50v50h-50z M20 20h20v20h-20z\"/>";
  CHECK(rule("<path" + d) == FillRule::NonZero);
  CHECK(rule("<path fill-rule=\"evenodd\"" + d) == FillRule::EvenOdd);
  CHECK(rule("<path style=\"fill:red; Fill-Rule : EvenOdd !important;\"" + d) == FillRule::EvenOdd);
  CHECK(rule("<g fill-rule=\"evenodd\"><g><path" + d + "</g></g>") == FillRule::EvenOdd);
  CHECK(rule("<g fill-rule=\"evenodd\"><path fill-rule=\"nonzero\"" + d + "</g>") == FillRule::NonZero);
  CHECK(rule("<g fill-rule=\"evenodd\"><path fill-rule=\"inherit\"" + d + "</g>") == FillRule::EvenOdd);
  CHECK(rule("<path fill-rule=\"evenodd\" style=\"fill-rule:nonzero\"" + d) == FillRule::NonZero);
  CHECK(rule("<style>.a{fill-rule:evenodd}</style><path class=\"x a\"" + d) == FillRule::EvenOdd);
  CHECK(rule("<style>.a{fill-rule:evenodd}</style><path class=\"a\" fill-rule=\"nonzero\"" + d) == FillRule::EvenOdd);
  CHECK(rule("<style>.a{fill-rule:evenodd}</style><path class=\"a\" style=\"fill-rule:nonzero\"" + d) ==
        FillRule::NonZero);
  CHECK(
      rule(
          "<style><![CDATA[ /* a */ @import 'x'; @media print{path{fill-rule:nonzero}} g, path {\nfill-rule:evenodd}]]>"
          "</style><path" +
          d) == FillRule::EvenOdd);
  CHECK(rule("<defs><style>#i{fill-rule:evenodd} path{fill-rule:nonzero} .a{fill-rule:nonzero}</style></defs>"
             "<path id=\"i\" class=\"a\"" +
             d) == FillRule::EvenOdd);
  CHECK(rule("<style>.a{fill-rule:nonzero}.b{fill-rule:evenodd}</style><path class=\"b a\"" + d) == FillRule::EvenOdd);
  CHECK(rule("<style>path.a{fill-rule:evenodd}.a{fill-rule:nonzero}</style><path class=\"a\"" + d) ==
        FillRule::EvenOdd);
  CHECK(rule("<style>g .a{fill-rule:evenodd}</style><g><path class=\"a\"" + d + "</g>") == FillRule::EvenOdd);
}

TEST_CASE("holes and several parts stay the rings of one path, in any winding") {
  for (const char* hole : {"M20 20h20v20h-20z", "M20 20v20h20v-20z"}) {
    const Shape shape = read(page("<path fill-rule=\"evenodd\" d=\"M10 10h50v50h-50z " + std::string(hole) +
                                  " M70 70h5v5z\"/>"
                                  "<circle cx=\"80\" cy=\"20\" r=\"5\"/>"));
    REQUIRE(shape.paths.size() == 2);
    REQUIRE(shape.paths[0].rings.size() == 3);
    CHECK(std::abs(shoelace(shape.paths[0].rings[0])) == doctest::Approx(2500));
    CHECK(std::abs(shoelace(shape.paths[0].rings[1])) == doctest::Approx(400));
    CHECK(shape.paths[1].rings.size() == 1);
  }
  const Shape opposed = readPath("M10 10h50v50h-50z M20 20v20h20v-20z");
  CHECK(shoelace(opposed.paths[0].rings[0]) * shoelace(opposed.paths[0].rings[1]) < 0);
}

TEST_CASE("what is not displayed or only defined is left out") {
  const std::string seen = "<rect width=\"10\" height=\"10\"/>";
  const std::string rect = "<rect x=\"50\" width=\"10\" height=\"10\"/>";
  for (const std::string& hidden :
       {"<g display=\"none\"><g>" + rect + "</g></g>", "<g style=\"fill:red;display : none\">" + rect + "</g>",
        "<style>.h{display:none}</style><g class=\"h\">" + rect + "</g>", "<defs>" + rect + "</defs>",
        "<symbol>" + rect + "</symbol>", "<clipPath>" + rect + "</clipPath>", "<mask>" + rect + "</mask>",
        "<pattern>" + rect + "</pattern>", "<marker>" + rect + "</marker>",
        "<linearGradient>" + rect + "</linearGradient>", "<metadata>" + rect + "</metadata>",
        "<x:g xmlns:x=\"y\">" + rect + "</x:g>", "<foreignObject>" + rect + "</foreignObject>",
        std::string(
            "<rect x=\"50\" width=\"0\" height=\"10\"/><circle cx=\"50\"/><path d=\"\"/><path d=\"none\"/><path/>"
            "<polygon/><path d=\"M50 50h10\"/><path d=\"M50 50h10l5 0\"/><path d=\"M50 50\"/>")}) {
    CAPTURE(hidden);
    const Shape shape = read(page(hidden + seen));
    CHECK(ringCount(shape) == 1);
    CHECK(ringArea(shape) == doctest::Approx(100));
  }
  CHECK(ringCount(read(
            page("<style>.h{display:none}</style><g class=\"h\" style=\"display:inline\">" + rect + "</g>"))) == 1);
  CHECK(ringCount(read(page("<switch><foreignObject requiredExtensions=\"x\"/><g>" + rect + "</g><g>" + rect +
                            "</g></switch>"))) == 1);
}

TEST_CASE("use shows elements again, moved, with inherited rules") {
  const std::string rect = "<rect id=\"r\" x=\"1\" y=\"2\" width=\"10\" height=\"10\"/>";
  checkBounds(read(page("<defs>" + rect + "</defs><use href=\"#r\" x=\"20\" y=\"30\"/>")), 21, 58, 31, 68);
  checkBounds(read(page("<use xlink:href=\"#r\" x=\"20\" transform=\"scale(2)\"/><defs>" + rect + "</defs>")), 42, 76,
              62, 96);
  CHECK(ringCount(read(page("<g id=\"g\">" + rect + rect + "</g><use href=\"#g\"/><use href=\"#g\" y=\"5\"/>"))) == 6);
  CHECK(read(page("<defs>" + rect + "</defs><use href=\"#r\" fill-rule=\"evenodd\"/>")).paths[0].fillRule ==
        FillRule::EvenOdd);
  CHECK(ringCount(read(page(rect + "<use href=\"#r\" display=\"none\"/><use/>"))) == 1);
  // Nested uses without a cycle.
  CHECK(ringCount(read(page("<defs>" + rect +
                            "<g id=\"a\"><use href=\"#r\"/><use href=\"#r\" x=\"20\"/></g></defs>"
                            "<use href=\"#a\"/><use href=\"#a\" y=\"20\"/>"))) == 4);
}

TEST_CASE("a used symbol is laid into its viewport") {
  const std::string symbol = "<symbol id=\"s\" viewBox=\"0 0 10 20\"><rect width=\"10\" height=\"20\"/></symbol>";
  // 40 x 40 at (10, 10): scaled by 2 to 20 x 40, in the middle.
  checkBounds(read(page(symbol + "<use href=\"#s\" x=\"10\" y=\"10\" width=\"40\" height=\"40\"/>")), 20, 50, 40, 90);
  // Without size: the whole page.
  checkBounds(read(page(symbol + "<use href=\"#s\"/>")), 25, 0, 75, 100);
  const std::string sized =
      "<svg id=\"s\" display=\"inline\" width=\"10\" height=\"20\" viewBox=\"0 0 1 2\"><rect width=\"1\" "
      "height=\"2\"/></svg>";
  checkBounds(read(page("<defs>" + sized + "</defs><use href=\"#s\" x=\"5\"/>")), 5, 80, 15, 100);
  checkBounds(read(page("<defs>" + sized + "</defs><use href=\"#s\" width=\"20\" height=\"40\"/>")), 0, 60, 20, 100);
}

TEST_CASE("nested svg elements have viewports of their own") {
  checkBounds(read(page("<svg x=\"10\" y=\"20\" width=\"40\" height=\"20\" viewBox=\"0 0 20 20\">"
                        "<rect width=\"100%\" height=\"100%\"/></svg>")),
              20, 60, 40, 80);
  checkBounds(
      read(page("<svg x=\"10\" y=\"20\" width=\"40\" height=\"20\"><rect width=\"50%\" height=\"50%\"/></svg>")), 10,
      70, 30, 80);
  CHECK(ringCount(read(
            page("<svg width=\"0\"><rect width=\"5\" height=\"5\"/></svg><rect width=\"5\" height=\"5\"/>"))) == 1);
}

TEST_CASE("prefixes, declarations, DOCTYPE, comments, entities and a byte order mark are no obstacle") {
  const Shape shape = read(
      "\xEF\xBB\xBF<?xml version=\"1.0\"?><!-- a > b <g> --><!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"x\" ["
      "<!ENTITY ns_svg \"http://www.w3.org/2000/svg\"><!ENTITY a \"<g><g>\">]>\n"
      "<svg:svg xmlns:svg=\"&ns_svg;\" width=\"10mm\" height='10mm' viewBox=\"0 0 10 10\"><?pi <g> ?>"
      "<svg:path d=\"M0&#32;0h4v4&#x68;-4\" desc='>\"/>'/><![CDATA[<g>]]><!-- <rect width=\"9\" height=\"9\"/> "
      "--></svg:svg>\n<!-- end -->");
  CHECK(ringArea(shape) == doctest::Approx(16));
}

TEST_CASE("entities of the DOCTYPE are what they stand for, and a bomb of them is refused quickly") {
  const auto drawing = [](const std::string& declarations, const std::string& body) {
    return "<!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.1//EN' 'svg11.dtd' [\n" + declarations + "\n]>\n" + page(body);
  };
  const std::string rect = "<rect width='10' height='5' ";
  const std::string stroked =
      "<!ENTITY % p 'x'><!-- <!ENTITY s0 'fill:red'> --><!ENTITY ext SYSTEM 'a.txt'>"
      "<!ENTITY s0 \"fill:none;\"><!ENTITY s0 'fill:red;'>\n<!ENTITY b '&s0;stroke:red;'>";
  CHECK(ringArea(read(drawing(stroked, rect + "style='&s0;'/><path d='M20 20h9v9h-9z'/>"))) == doctest::Approx(81));
  CHECK(read(drawing(stroked, rect + "style='&b;'/>")).drawing.linesOnly);
  CHECK(ringArea(read(drawing("<!ENTITY p 'M0 0h9v9h-9z'>", "<path d='&p;'/>"))) == doctest::Approx(81));
  CHECK(ringArea(read(drawing("<!ENTITY r \"" + rect + "/>\">", "&r;<title>&amp;&unknown;&</title>"))) ==
        doctest::Approx(50));
  checkRefused(drawing("<!ENTITY p 'M0 0h'>", "\n<path d='&p;'/>"), ErrorCode::InvalidFile, {"<path> in line 5"});

  std::string bomb = "<!ENTITY l0 'ha'>", many;
  for (int k = 1; k < 30; ++k) {
    std::string ten;
    for (int n = 0; n < 10; ++n) ten += "&l" + std::to_string(k - 1) + ";";
    bomb += "<!ENTITY l" + std::to_string(k) + " '" + ten + "'>";
  }
  checkRefused(drawing(bomb, rect + "id='&l29;'/>"), ErrorCode::TooLarge, {"entities"});
  for (int k = 0; k < 1000; ++k) many += "&p;";
  checkRefused(drawing("<!ENTITY p '" + std::string(100000, 'x') + "'>", rect + "id='" + many + "'/>"),
               ErrorCode::TooLarge, {"entities"});
  for (const char* broken : {"<!ENTITY", "<!ENTITY p", "<!ENTITY p '", "<!ENTITY p 'x'", "<!--", "]"}) {
    CAPTURE(std::string(broken));
    CHECK_FALSE(readSvg("<!DOCTYPE svg [" + std::string(broken)).ok());
  }
}

TEST_CASE("points lie on a grid of 1 nm, none is repeated, and every ring is a polygon") {
  const Shape shape =
      read(page("<path transform=\"rotate(33.3)\" d=\"M10 10C40 0 60 70 20 30 L20 30 L20 30.0000001z\"/>"
                "<circle cx=\"33.333\" cy=\"44\" r=\"0.0001\"/>"));
  CHECK(ringCount(shape) == 2);
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) {
      REQUIRE(ring.size() >= 3);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        CHECK(std::round(ring[i].x * 1e6) / 1e6 == ring[i].x);
        CHECK(std::round(ring[i].y * 1e6) / 1e6 == ring[i].y);
        CHECK_FALSE(ring[i] == ring[(i + 1) % ring.size()]);
        CHECK_FALSE((ring[i].x == 0 && std::signbit(ring[i].x)));
      }
    }
  }
}

TEST_CASE("files that are no SVG are refused by name") {
  const auto bad = ErrorCode::InvalidFile;
  checkRefused("", bad, {"<svg>"});
  checkRefused("hello", bad, {"XML"});
  checkRefused("<!-- only -->", bad, {"<svg>"});
  checkRefused("<html><body/></html>", bad, {"html", "<svg>"});
  checkRefused("\x1f\x8b\x08 zipped", bad, {".gz", "cut off"});
  checkRefused(std::string("<\0s\0v\0g\0", 8), bad, {"UTF-8"});
  checkRefused("<svg width=\"1mm\" height=\"1mm\">\n<g>", bad, {"XML", "line"});
  checkRefused("<svg>\n</g>", bad, {"XML", "line 2"});
  checkRefused("<svg>\n<g></svg>", bad, {"XML", "line 2"});
  checkRefused("<svg>\n<g id=5/></svg>", bad, {"XML", "line 2"});
  checkRefused("<svg>\n<g id/></svg>", bad, {"XML", "line 2"});
  checkRefused("<svg>\n\n<g id=\"a", bad, {"XML", "line 3"});
  checkRefused("<svg><!-- ", bad, {"XML"});
  checkRefused("<svg><![CDATA[ ", bad, {"XML"});
  checkRefused("<!DOCTYPE svg [", bad, {"XML"});
  checkRefused("<svg><!ELEMENT a></svg>", bad, {"XML"});
  checkRefused("<svg><1 \"></svg>", bad, {"XML"});
}

TEST_CASE("pages without a sensible size are refused with the value") {
  const auto page = [](const std::string& attributes) {
    return "<svg " + attributes + "><rect width=\"1\" height=\"1\"/></svg>";
  };
  const auto bad = ErrorCode::InvalidFile;
  checkRefused("<svg><g/></svg>", bad, {"size", "viewBox"});
  checkRefused(page("width=\"5mm\""), bad, {"size"});
  checkRefused(page("width=\"0\" height=\"5\""), bad, {"width", "\"0\"", "100000 mm"});
  checkRefused(page("width=\"5\" height=\"-5mm\""), bad, {"height", "-5mm"});
  checkRefused(page("width=\"5m\" height=\"5\""), bad, {"width", "5m", "units"});
  checkRefused(page("width=\"nan\" height=\"5\""), bad, {"width", "nan"});
  checkRefused(page("width=\"inf\" height=\"5\""), bad, {"width", "inf"});
  checkRefused(page("width=\"\" height=\"5\""), bad, {"width"});
  checkRefused(page("width=\"1e999\" height=\"5\""), bad, {"width", "1e999"});
  checkRefused(page("width=\"100001mm\" height=\"5\""), ErrorCode::TooLarge, {"width", "100001mm", "100000 mm"});
  checkRefused(page("viewBox=\"0 0 1e9 1\""), ErrorCode::TooLarge, {"viewBox", "1e9"});
  checkRefused(page("viewBox=\"0 0 0 1\""), bad, {"viewBox", "0 0 0 1"});
  checkRefused(page("viewBox=\"0 0 5 -1\""), bad, {"viewBox"});
  checkRefused(page("viewBox=\"0 0 5\""), bad, {"viewBox"});
  checkRefused(page("viewBox=\"0 0 5 5 5\""), bad, {"viewBox"});
  for (const char* ratio : {"xMidYmid", "xMid", "middle", "xMidYMid fit", "xFooYMid", "none meet x", "xMidYMid 3"}) {
    checkRefused(page(std::string("viewBox=\"0 0 5 5\" preserveAspectRatio=\"") + ratio + "\""), bad,
                 {"preserveAspectRatio", ratio});
  }
}

TEST_CASE("broken attributes name their element and line") {
  const auto bad = [](const std::string& element, const std::vector<std::string>& words) {
    std::vector<std::string> all = words;
    all.push_back("line 2");
    checkRefused(page("\n" + element + "<rect width=\"9\" height=\"9\"/>"), ErrorCode::InvalidFile, all);
  };
  bad("<path id=\"p1\" d=\"M10 10 L20\"/>", {"<path id=\"p1\">", "\"\"", "number"});
  bad("<path d=\"L10 10\"/>", {"<path>", "M"});
  bad("<path d=\"10 10\"/>", {"M"});
  bad("<path d=\"M10 10 20 20 B 5 5\"/>", {"B 5 5", "command"});
  bad("<path d=\"M10 10 h 1 ; 5\"/>", {"; 5"});
  bad("<path d=\"M10 10 z 5\"/>", {"command"});
  bad("<path d=\"M10 10 L nan 5\"/>", {"nan"});
  bad("<path d=\"M10 10 L inf 5\"/>", {"inf"});
  bad("<path d=\"M10 10 L 1e400 5\"/>", {"1e400"});
  bad("<path d=\"M10 10 L - 5\"/>", {"number"});
  bad("<path d=\"M10 10 L +-5 5\"/>", {"number"});
  bad("<path d=\"M10 10 L 5,,5\"/>", {"number"});
  bad("<path d=\"M10 10 A 5 5 0 2 0 9 9\"/>", {"flag"});
  bad("<path d=\"M10 10 A 5 5 0 0 0 9\"/>", {"number"});
  bad("<path d=\"M10 10 A 1e-200 1e-200 0 0 0 9 9\"/>", {"arc"});
  bad("<path d=\"M10 10 L 1e30 5 6 6z\"/>", {"1 km"});
  bad("<g transform=\"scale(1e300)\"><path d=\"M10 10 h1e300 v5z\"/></g>", {"1 km"});
  bad("<polygon points=\"1 2 3\"/>", {"<polygon>", "points"});
  bad("<polygon points=\"1 2 x\"/>", {"x"});
  bad("<rect width=\"-5\" height=\"5\"/>", {"<rect>", "-5", "negative"});
  bad("<rect width=\"5\" height=\"5\" rx=\"-1\"/>", {"rx", "-1"});
  bad("<circle r=\"5 5\"/>", {"<circle>", "units"});
  bad("<circle r=\"-5\"/>", {"-5"});
  bad("<g transform=\"turn(5)\"/>", {"<g>", "turn"});
  bad("<g transform=\"rotate(5\"/>", {"transform", "must stand"});
  bad("<g transform=\"rotate(5 5)\"/>", {"rotate"});
  bad("<g transform=\"matrix(1 2 3 4 5)\"/>", {"matrix"});
  bad("<g transform=\"matrix(1 2 3 4 5 6 7)\"/>", {"transform", ")"});
  bad("<g transform=\"scale()\"/>", {"scale"});
  bad("<g transform=\"7\"/>", {"7"});
  bad("<use href=\"#missing\"/>", {"<use>", "#missing"});
  bad("<use href=\"other.svg#a\"/>", {"other.svg#a", "#id"});
  bad("<use id=\"\x01\xff\" href=\"x\"/>", {"id=\"??\""});
}

TEST_CASE("drawings without area are empty shapes") {
  for (const char* body :
       {"", "<line x1=\"1\" x2=\"9\"/>", "<text>abc</text>", "<path d=\"M1 1h9v0h5z\"/>",
        "<g transform=\"scale(0)\"><rect width=\"9\" height=\"9\"/></g>",
        "<g transform=\"rotate(30) scale(1 0)\"><circle r=\"9\"/></g>", "<g display=\"none\"><circle r=\"9\"/></g>"}) {
    checkRefused(page(body), ErrorCode::EmptyShape, {"no area", "paths"});
  }
  checkRefused(page("<rect width=\"9\" height=\"9\"/>", "display=\"none\""), ErrorCode::EmptyShape, {"no area"});
  // Crossing itself in the middle: no signed area, yet a shape.
  CHECK(ringCount(readPath("M10 10L20 20V10L10 20z")) == 1);
}

TEST_CASE("what a drawing leaves open, and what is not read of it, is told") {
  const auto facts = [](const std::string& root, const std::string& content, bool mm = false) {
    const Result<Shape> shape = readSvg("<svg " + root + "><rect width='9' height='9'/>" + content + "</svg>", {mm});
    REQUIRE(shape.ok());
    return shape.value().drawing;
  };
  CHECK(facts("width='10mm' height='10mm'", "") == DrawingFacts{.svg = true});
  for (const char* pixels : {"width='10px' height='10px'", "width='10' height='10'", "viewBox='0 0 10 10'",
                             "width='100%' height='100%' viewBox='0 0 10 10'"}) {
    CAPTURE(pixels);
    CHECK(facts(pixels, "").pixels);
  }
  CHECK_FALSE(facts("width='10' height='10'", "", true).pixels);
  const std::string shown = "<g><text x='1'>a<tspan>b</tspan></text><image width='1' height='1'/></g><text>c</text>";
  CHECK(facts("viewBox='0 0 10 10'", shown) == DrawingFacts{.svg = true, .pixels = true, .texts = 2, .images = 1});
  CHECK(facts("viewBox='0 0 10 10'", "<defs>" + shown + "</defs><text style='display:none'>d</text>").texts == 0);
  CHECK(makeDisc(5).value().drawing == DrawingFacts{});
}

TEST_CASE("use that shows itself is refused") {
  for (const char* body :
       {"<use id=\"a\" href=\"#a\"/>", "<g id=\"a\"><use href=\"#a\"/></g>",
        "<defs><g id=\"a\"><use href=\"#b\"/></g><g id=\"b\"><use href=\"#a\"/></g></defs><use href=\"#a\"/>",
        "<symbol id=\"a\"><rect width=\"5\" height=\"5\"/><use href=\"#a\"/></symbol><use href=\"#a\"/>"}) {
    checkRefused(page(body), ErrorCode::InvalidFile, {"<use", "itself"});
  }
}

TEST_CASE("hostile sizes end in an error, quickly") {
  const auto many = [](const std::string& piece, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += piece;
    return text;
  };
  // Billion laughs: 10 levels of 10 uses.
  std::string laughs = "<defs><g id=\"l0\"><path d=\"\"/></g>";
  for (int i = 1; i <= 10; ++i) {
    laughs += std::string("<g id=\"l") + std::to_string(i) + "\">" +
              many(std::string("<use href=\"#l") + std::to_string(i - 1) + "\"/>", 10) + "</g>";
  }
  checkRefused(page(laughs + "</defs><use href=\"#l10\"/>"), ErrorCode::TooLarge, {"use"});

  // A long chain of uses would exhaust the stack.
  std::string chain = "<defs><rect id=\"c0\" width=\"5\" height=\"5\"/>";
  for (int i = 1; i <= 5000; ++i)
    chain += std::string("<use id=\"c") + std::to_string(i) + "\" href=\"#c" + std::to_string(i - 1) + "\"/>";
  checkRefused(page(chain + "</defs><use href=\"#c5000\"/>"), ErrorCode::TooLarge, {"200"});

  checkRefused(page(many("<g>", 300000)), ErrorCode::TooLarge, {"200"});
  checkRefused(many("<a b\"c=\"x\">", 300000), ErrorCode::InvalidFile, {"XML"});     // quotes inside names
  checkRefused(many("<a b='<!--'>", 300000) + "-->", ErrorCode::TooLarge, {"200"});  // comments inside values
  checkRefused(many("<!-- --><a/><b><![CDATA[</b>]]>", 300000), ErrorCode::TooLarge, {"200"});
  checkRefused("<!DOCTYPE a [" + many("[", 300000), ErrorCode::InvalidFile, {"XML"});
  CHECK(readSvg(page(many("<g>", 190) + "<rect width=\"5\" height=\"5\"/>" + many("</g>", 190))).ok());

  checkRefused(page("<path d=\"M0 0" + many("h1v1", 1'100'000) + "\"/>"), ErrorCode::TooLarge, {"points"});
  checkRefused(page("<path d=\"M0 0" + many("a40 40 0 1 0 9 9", 100'000) + "\"/>"), ErrorCode::TooLarge, {"points"});
  checkRefused(page("<path d=\"M0 0C1e300 1e300 1e300 -1e300 5 5z\"/>"), ErrorCode::TooLarge, {"points"});
  checkRefused(std::string((std::size_t{64} << 20) + 1, ' '), ErrorCode::TooLarge, {"65 MiB", "at most 64"});
  checkRefused(page("<path d=\"M0 0h" + many("9", 1'000'000) + "\"/>"), ErrorCode::InvalidFile, {"number"});
  CHECK(readSvg(page("<path d=\"M0 0h1." + many("9", 1'000'000) + "v5z\"/>")).ok());
}

TEST_CASE("tolerances out of range are refused") {
  for (const double tolerance : {0.0, -1.0, 11.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Result<Shape> shape = readSvg(page("<circle r=\"5\"/>"), {.tolerance = tolerance});
    REQUIRE_FALSE(shape.ok());
    CHECK(shape.error().code == ErrorCode::InvalidArgument);
    CHECK(shape.error().message.find("tolerance") != std::string::npos);
  }
}

TEST_CASE("truncated and altered files end in a shape or an error") {
  const std::array<std::string, 5> files{
      page("<g transform=\"translate(5 5) rotate(30)\"><path d=\"M10 10C40 0 60 70 20 30S5 5 9 9Q1 2 3 4T5 6A5 5 0 01 "
           "9 9z\"/></g>"),
      page("<defs><symbol id=\"s\" viewBox=\"0 0 9 9\"><rect rx=\"2\" width=\"9\" height=\"9\"/></symbol></defs>"
           "<use href=\"#s\" x=\"5\" width=\"50%\"/><use xlink:href=\"#s\" height=\"2cm\"/>"),
      "<?xml version=\"1.0\"?><!DOCTYPE svg [<!ENTITY a \"b\">]><svg width=\"5mm\" height=\"5mm\"><!-- c "
      "--><style><![CDATA[.a,b#c"
      "{fill-rule:evenodd;display:none}]]></style><polygon class=\"a d\" points=\"1,2 3,4 5 1\"/><circle "
      "r=\"5&#48;\"/></svg>",
      page("<svg x=\"5\" width=\"50\" preserveAspectRatio=\"xMinYMax slice\" viewBox=\"1 2 3 4\"><ellipse rx=\"5%\" "
           "ry=\"2\"/></svg>"),
      page("<g id=\"a\" style=\"fill-rule:evenodd\"><switch><g><use href=\"#b\"/></g></switch></g><path id=\"b\" "
           "transform=\"matrix(1 2 3 4 5 6) skewX(3)\" d=\"m1 2h3v4l5 6z\"/>")};
  std::uint64_t state = 12345;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>((state >> 33) % below);
  };
  const std::string alphabet = "<>/\"'=&;#%-.,09eEMzAa \n[]!?{}:";
  int read = 0, refused = 0;
  for (int round = 0; round < 6000; ++round) {
    std::string text = files[random(files.size())];
    if (random(3) == 0) text.resize(random(text.size()));
    for (std::size_t flips = random(4); flips > 0 && !text.empty(); --flips) {
      char& c = text[random(text.size())];
      c = random(2) == 0 ? alphabet[random(alphabet.size())] : static_cast<char>(random(256));
    }
    if (random(6) == 0 && !text.empty()) {
      const std::size_t from = random(text.size());
      const std::string piece = text.substr(from, random(40));
      text.insert(random(text.size()), piece);
    }
    const Result<Shape> shape = readSvg(text);
    if (shape.ok()) {
      ++read;
      for (const FilledPath& path : shape.value().paths) {
        for (const Ring& ring : path.rings) REQUIRE(ring.size() >= 3);
      }
    } else {
      ++refused;
      REQUIRE(shape.error().message.size() > 10);
      REQUIRE(shape.error().code != ErrorCode::Internal);
    }
  }
  CHECK(read > 300);
  CHECK(refused > 300);
}

TEST_CASE("the published scenes have their pages and outlines") {
  struct Scene {
    const char* file;
    double width, height;
    std::size_t rings;
  };
  const std::array<Scene, 10> scenes{{{"brain", 64.9984, 52.4986, 2},
                                      {"rectangle_170_114p8", 170, 114.86487, 1},
                                      {"square_140", 140, 140, 1},
                                      {"square_27", 27, 27, 1},
                                      {"square_70", 70, 70, 1},
                                      {"stress_140", 140.63849, 140.1458, 1},
                                      {"stress_17p5", 17.499998, 17.536825, 1},
                                      {"stress_35", 34.999996, 35.07365, 1},
                                      {"stress_70", 69.999992, 70.147278, 1},
                                      {"teaser_200_90p5", 199.99028, 90.50444, 9}}};
  for (const Scene& scene : scenes) {
    const std::string name = std::string(SILLON_SOURCE_DIR "/examples/paper/svg/") + scene.file + ".svg";
    std::ifstream file(name, std::ios::binary);
    CAPTURE(name);
    REQUIRE(file);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const Shape shape = read(text, {.unitlessIsMm = true, .ignorePaint = true});
    CHECK(shape.page.x == doctest::Approx(scene.width).epsilon(1e-9));
    CHECK(shape.page.y == doctest::Approx(scene.height).epsilon(1e-9));
    CHECK(ringCount(shape) == scene.rings);
    const Bounds box = bounds(shape);
    // With its transforms applied, no drawing hangs out of its page.
    CHECK(box.min.x > -0.001);
    CHECK(box.min.y > -0.001);
    CHECK(box.max.x < shape.page.x + 0.001);
    CHECK(box.max.y < shape.page.y + 0.001);
  }
}

// ---- as painted ----

namespace {

// Of what is inside, resolved: overlaps count once.
double shownArea(const std::string& body, const SvgOptions& options = {}) {
  const Result<Outline> outline = resolveOutline(read(page(body), options));
  REQUIRE(outline.ok());
  return outline.value().area;
}

void checkShown(const std::string& body, double expected, double curveLength = 0) {
  INFO(body);
  CHECK(std::abs(shownArea(body) - expected) <= 1e-6 * expected + 0.004 * curveLength);
}

const std::string kSquare = "<rect x='10' y='10' width='10' height='10'/>";  // 100 mm2

}  // namespace

TEST_CASE("what is not painted is not there, as long as something is") {
  for (const char* hidden : {"fill='none'",
                             "fill='transparent'",
                             "fill='#0000'",
                             "fill='#12345600'",
                             "fill='rgba(9,9,9,0)'",
                             "fill='rgb(9 9 9 / 0%)'",
                             "fill='hsla(1,2%,3%,0.0)'",
                             "fill-opacity='0'",
                             "fill-opacity='0%'",
                             "opacity='0'",
                             "visibility='hidden'",
                             "visibility='collapse'",
                             "style='fill:none'",
                             "style='visibility:hidden'",
                             "fill='url(#nothing)'",
                             "fill='url(#nothing) none'",
                             "color='#0000' fill='currentColor'",
                             "class='hidden'",
                             "fill='#ffffff01'",
                             "fill-opacity='0.01'",
                             "opacity='.1' fill-opacity='.1'",
                             "style='fill:red' class='important'"}) {
    CAPTURE(hidden);
    checkShown("<style>.hidden{opacity:0} .important{fill:none ! important}</style><g>" + kSquare +
                   "</g><path d='M0 0h90v90h-90z' " + hidden + "/>",
               100);
  }
  for (const char* shown :
       {"fill='white'", "fill='#fff'", "fill='#ffffff06'", "fill-opacity='0.03'", "opacity='.5'", "fill='url(#g)'",
        "fill='url(#nothing) red'", "fill='nonsense'", "fill='currentColor'", "style='fill:rgb(1,2,3)'"}) {
    CAPTURE(shown);
    checkShown("<linearGradient id='g'><stop/></linearGradient><rect width='90' height='90' " + std::string(shown) +
                   "/>" + kSquare,
               8100);
  }
  // Opacity of groups multiplies; visibility may be taken back.
  checkShown(kSquare + "<g opacity='0'><g opacity='1'><rect width='90' height='90'/></g></g>", 100);
  checkShown(kSquare +
                 "<g visibility='hidden'><rect width='90' height='90'/><rect x='50' y='50' width='20' "
                 "height='10' visibility='visible'/></g>",
             300);
}

TEST_CASE("outlines without paint are joined, and alternate between solid and hole") {
  const auto area = [](const std::string& content) {
    return resolveOutline(read(page("<g fill='none'>" + content + "</g>"), kOutlines)).value().area;
  };
  const auto square = [](int from, int side) {
    return "<rect x='" + std::to_string(from) + "' y='" + std::to_string(from) + "' width='" + std::to_string(side) +
           "' height='" + std::to_string(side) + "'/>";
  };
  for (int depth = 1; depth <= 6; ++depth) {
    std::string nested;
    double expected = 0;
    for (int k = depth; k-- > 0;) {  // the innermost first
      nested += square(5 * k, 90 - 10 * k);
      expected += (k % 2 == 0 ? 1 : -1) * (90.0 - 10 * k) * (90 - 10 * k);
    }
    CHECK(area(nested) == doctest::Approx(expected));
  }
  CHECK(area(square(10, 20) + square(20, 20)) == doctest::Approx(700));  // crossing ones are one body
  CHECK(area(square(10, 20) + square(10, 20)) == doctest::Approx(400));  // and so are equal ones
  CHECK(area(square(10, 20) + square(50, 20)) == doctest::Approx(800));

  // A circle of 628 pieces of 0.2, whose ends are up to 0.02 apart, in any order and way.
  std::vector<std::string> pieces;
  for (int k = 0; k < 628; ++k) {
    const auto end = [&](int n, double off) {
      const double angle = n * 2 * std::numbers::pi / 628;
      return std::to_string(50 + off + 20 * std::cos(angle)) + " " + std::to_string(50 - off + 20 * std::sin(angle));
    };
    const std::string from = end(k, 0.005 * (k % 3)), to = end(k + 1, -0.005 * (k % 2));
    pieces.push_back("<path d='M" + (k % 2 == 0 ? from + "L" + to : to + "L" + from) + "'/>");
  }
  std::string forwards, mixed;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    forwards += pieces[k];
    mixed += pieces[k * 5 % pieces.size()];
  }
  CHECK(area(forwards) == doctest::Approx(400 * std::numbers::pi).epsilon(0.002));
  CHECK(area(mixed) == doctest::Approx(400 * std::numbers::pi).epsilon(0.002));
  CHECK(area(mixed + square(60, 1)) == doctest::Approx(400 * std::numbers::pi - 1).epsilon(0.002));
  // A piece that no other continues spans what it did alone.
  CHECK(area("<path d='M10 10H20V20'/><path d='M20 20V30'/>") == doctest::Approx(50));
}

TEST_CASE("nothing painted is said, and its outlines are the shape") {
  const Shape shape = read(page("<g fill='none'>" + kSquare + "</g>"));
  CHECK(shape.drawing.unpainted);
  CHECK(ringArea(shape) == doctest::Approx(100));
  CHECK_FALSE(read(page(kSquare)).drawing.unpainted);
  CHECK_FALSE(read(page("<g fill='none'>" + kSquare + "</g>"), kOutlines).drawing.unpainted);
  CHECK(read(page("<style>rect:first-child{fill:red}</style><g fill='none'>" + kSquare + "</g>")).drawing.unread ==
        std::vector<std::string>{"CSS \"rect:first-child\""});
  // Text is painted, and cannot be read: its frame must not stand for it.
  checkRefused(page("<g fill='none'>" + kSquare + "</g><text>a</text>"), ErrorCode::EmptyShape, {"text"});
}

TEST_CASE("a second tone by opacity is told by its area; shadows on what is painted firmly are not") {
  const std::string firm = "<rect width='20' height='20'/>";
  const auto faint = [&](const std::string& content) { return read(page(content)).drawing.faintMm2; };
  CHECK(faint(firm) == 0);
  CHECK(faint(firm + "<rect x='40' y='10' width='10' height='30' opacity='.4'/>") == doctest::Approx(300));
  CHECK(faint("<g opacity='0.2'><rect x='10' y='10' width='20' height='20'/></g>" + firm) == doctest::Approx(300));
  CHECK(faint(firm + "<path d='M40 20H60' stroke='red' stroke-width='4' stroke-opacity='.5'/>") == doctest::Approx(80));
  CHECK(faint(firm + "<rect x='40' y='10' width='10' height='30' opacity='.8'/>") == 0);
  CHECK(faint(firm + "<rect x='5' y='5' width='5' height='5' fill='#fff' opacity='.3'/>") == 0);
  CHECK(faint(firm + "<rect x='5' y='20' width='10' height='0.1' opacity='.3'/>") == 0);
  CHECK(faint("<rect width='20' height='20' opacity='.3'/>") == 0);  // one tone
}

TEST_CASE("several colours are told, in whatever words they are written") {
  const auto several = [](std::string_view first, std::string_view second) {
    const auto square = [](std::string_view fill) {
      return "<rect width='9' height='9' fill='" + std::string(fill) + "'/>";
    };
    const std::string gradients =
        "<linearGradient id='a'><stop stop-color='red'/></linearGradient>"
        "<linearGradient id='b'><stop stop-color='red'/></linearGradient>";
    return read(page(gradients + square(first) + square(second))).drawing.severalColours;
  };
  const std::pair<std::string_view, std::string_view> equal[] = {{"black", "#000"},
                                                                 {"black", "rgb(0 0 0)"},
                                                                 {"black", "hsl(90 50% 0%)"},
                                                                 {"white", "#FFF"},
                                                                 {"white", "rgb(100%,100%,100%)"},
                                                                 {"white", "hsl(0, 0%, 100%)"},
                                                                 {"#1A2b3c", "rgb(26, 43, 60)"},
                                                                 {"#1A2b3c80", "rgba(26, 43, 60, .5)"},
                                                                 {"#f80", "#ff8800"},
                                                                 {"teal", "Teal"},
                                                                 {"teal", "#008080"},
                                                                 {"green", "hsl(120 100% 25%)"},
                                                                 {"currentColor", "#000000"},
                                                                 {"url(#a)", "url(#a)"},
                                                                 {"hsl(120 40% 50%)", "hsl(120 40% 50%)"},
                                                                 {"red", "none"}};
  for (const auto& pair : equal) {
    CAPTURE(pair.first);
    CHECK_FALSE(several(pair.first, pair.second));
  }
  const std::pair<std::string_view, std::string_view> other[] = {{"black", "white"},
                                                                 {"red", "green"},
                                                                 {"#f80", "#f81"},
                                                                 {"url(#a)", "url(#b)"},
                                                                 {"rgb(1,2,3)", "rgb(1,2,4)"},
                                                                 {"#000", "#010000"},
                                                                 {"hsl(1 40% 50%)", "hsl(200 40% 50%)"}};
  for (const auto& pair : other) {
    CAPTURE(pair.first);
    CHECK(several(pair.first, pair.second));
  }
  // Not what is off the page, hidden, or of a mask.
  CHECK_FALSE(
      read(page("<rect width='9' height='9'/><rect x='900' width='9' height='9' fill='red'/>")).drawing.severalColours);
  CHECK_FALSE(read(page("<mask id='m'><rect width='9' height='9' fill='white'/></mask>"
                        "<rect width='19' height='9' mask='url(#m)'/>"))
                  .drawing.severalColours);
}

TEST_CASE("a stroke is as wide as it says, with the ends and corners it asks for") {
  const std::string line = "<path d='M20 20H60' stroke='red' stroke-width='4' ";
  checkShown(line + "/>", 160);
  checkShown(line + "stroke-linecap='square'/>", 176);
  checkShown(line + "stroke-linecap='round'/>", 160 + std::numbers::pi * 4, 13);
  checkShown("<line x1='20' y1='20' x2='60' y2='20' stroke='red' stroke-width='1mm'/>", 40 * 96 / 25.4);
  checkShown("<line x1='20' y1='20' x2='60' y2='20' style='stroke:red;stroke-width:10%'/>", 400);
  checkShown("<g stroke='red' transform='scale(2 1)'><path d='M10 20H30' stroke-width='3'/></g>", 120);
  checkShown("<g stroke='red' transform='scale(2 1)'><path d='M20 10V30' stroke-width='3'/></g>", 120);
  CHECK(read(page(line + "/>")).drawing.linesOnly);
  CHECK_FALSE(read(page(line + "/>" + kSquare)).drawing.linesOnly);

  // A right angle: the corner adds a square, a quarter disc or a triangle of half widths.
  const std::string angle = "<path fill='none' d='M20 20H60V60' stroke='red' stroke-width='4' stroke-linejoin=";
  checkShown(angle + "'miter'/>", 320 - 4 + 4);
  checkShown(angle + "'bevel'/>", 320 - 4 + 2);
  checkShown(angle + "'round'/>", 320 - 4 + std::numbers::pi, 4);
  checkShown(angle + "'miter' stroke-miterlimit='1.4'/>", 320 - 4 + 2);  // sqrt 2 is the miter's length
  checkShown(angle + "'miter' stroke-miterlimit='1.42'/>", 320 - 4 + 4);
  // Closed, and its own fill within: a square of 20 with a frame of 4 around its edge.
  checkShown("<rect x='20' y='20' width='20' height='20' fill='none' stroke='red' stroke-width='4'/>",
             24 * 24 - 16 * 16);
  checkShown("<rect x='20' y='20' width='20' height='20' stroke='red' stroke-width='4'/>", 24 * 24);
  checkShown("<polygon points='20,20 40,20 40,40 20,40' fill='none' stroke='red' stroke-width='4'/>",
             24 * 24 - 16 * 16);
  checkShown("<polyline points='20,20 40,20 40,40 20,40' fill='none' stroke='red' stroke-width='4'/>",
             3 * 80 - 2 * 4 + 2 * 4);
  // A ring; wider than its radius there is no hole, and nothing cancels.
  checkShown("<circle cx='50' cy='50' r='20' fill='none' stroke='red' stroke-width='4'/>",
             std::numbers::pi * (22 * 22 - 18 * 18), 250);
  checkShown("<circle cx='50' cy='50' r='10' fill='none' stroke='red' stroke-width='24'/>", std::numbers::pi * 22 * 22,
             140);
  // One drawn as a line that ends where it began.
  const std::string open = "<path d='M40 50a10 10 0 1 0 20 0a10 10 0 1 0 -20 0' fill='none' stroke='red' stroke-width=";
  checkShown(open + "'4'/>", std::numbers::pi * (12 * 12 - 8 * 8), 130);
  checkShown(open + "'24'/>", std::numbers::pi * 22 * 22, 140);
  checkShown(open + "'24' stroke-linecap='round' stroke-dasharray='1000'/>", std::numbers::pi * 22 * 22, 140);
  // A tiny one as icons have it, in which all that is laid aside meets in one point.
  checkShown(kSquare + "<path d='M84.87 85a.13 .13 0 1 0 .26 0a.13 .13 0 1 0 -.26 0' stroke='red' stroke-width='.53'/>",
             100 + std::numbers::pi * 0.395 * 0.395, 2.5);
  // A corner where it ends is no join.
  checkShown("<path d='M20 20H40V40H20V20' fill='none' stroke='red' stroke-width='4'/>", 320 - 4 + 4 - 4);
  // There and back again, over a tight bend.
  checkShown("<path d='M20 50H60H20' stroke='red' stroke-width='4' stroke-linecap='round' stroke-linejoin='round'/>",
             160 + std::numbers::pi * 4, 13);
  // A dot is a line without length.
  const std::string dot = "<path d='M50 50h0' stroke='red' stroke-width='10' stroke-linecap=";
  checkShown(dot + "'round'/>", std::numbers::pi * 25, 32);
  checkShown(dot + "'square'/>", 100);
  checkShown(dot + "'butt'/>" + kSquare, 100);
  // Nothing of a stroke without paint, width or visibility.
  for (const char* none : {"stroke='none'", "stroke='red' stroke-width='0'", "stroke='red' stroke-opacity='0'",
                           "stroke='red' visibility='hidden'", "stroke='#f000'"}) {
    CAPTURE(none);
    checkShown(kSquare + "<path d='M20 20H60' " + none + "/>", 100);
  }
  // What cannot be read counts as missing, as in CSS.
  checkShown("<g stroke='red' stroke-width='4'><path d='M20 20H60' stroke-width='-1'/></g>", 160);
  checkShown("<g stroke='red' stroke-width='4'><path d='M20 20H60' stroke-width='thick' stroke-linecap='odd'/></g>",
             160);
}

TEST_CASE("strokes of curves have the area that Pappus gives") {
  // Length times width, as long as the half width is below the least radius of curvature.
  const double half = std::numbers::pi * 20;
  checkShown("<path d='M30 50A20 20 0 0 1 70 50' fill='none' stroke='red' stroke-width='6'/>", 6 * half, 2 * half);
  checkShown("<path d='M30 50A20 20 0 0 1 70 50' fill='none' stroke='red' stroke-width='6' stroke-linejoin='bevel'/>",
             6 * half, 2 * half);
}

TEST_CASE("dashes cut a stroke into pieces with caps of their own") {
  const auto dashed = [](const std::string& rest) {
    return "<path d='M20 20H60' stroke='red' stroke-width='4' " + rest + "/>";
  };
  checkShown(dashed("stroke-dasharray='6 4'"), 4 * 6 * 4);
  checkShown(dashed("stroke-dasharray='5'"), 4 * 5 * 4);
  checkShown(dashed("stroke-dasharray='5,3,2'"), 4 * (5 + 2 + 3 + 5 + 2 + 3));  // 5-3+2-5+3-2+ twice
  checkShown(dashed("stroke-dasharray='6 4' stroke-dashoffset='3'"), 4 * (3 + 6 + 6 + 6 + 3));
  checkShown(dashed("stroke-dasharray='6 4' stroke-dashoffset='-2'"), 4 * (6 + 6 + 6 + 6));
  checkShown(dashed("stroke-dasharray='0 10' stroke-linecap='round'"), 4 * std::numbers::pi * 4,
             50);  // none begins at the end
  checkShown(dashed("stroke-dasharray='4 6' stroke-linecap='round'"), 4 * (16 + std::numbers::pi * 4), 50);
  for (const char* solid : {"none", "0", "0 0", "-1 2", "5 x"}) {
    checkShown(dashed("stroke-dasharray='" + std::string(solid) + "'"), 160);
  }
  // Around a corner: 40 of 60 mm from the start, the corner with its miter.
  checkShown("<path d='M20 20H50V50' fill='none' stroke='red' stroke-width='4' stroke-dasharray='40 100'/>",
             160 - 4 + 4);
}

TEST_CASE("what lies off the page is cut off, and said in mm2") {
  const Shape half = read(page("<rect x='-10' y='40' width='20' height='10'/>"));
  CHECK(ringArea(half) == doctest::Approx(100));
  CHECK(half.drawing.offPage == doctest::Approx(100));
  checkBounds(half, 0, 50, 10, 60);
  const Shape beside = read(page(kSquare + "<circle cx='-30' cy='20' r='10'/>"));
  CHECK(ringArea(beside) == doctest::Approx(100));
  CHECK(beside.drawing.offPage == doctest::Approx(std::numbers::pi * 100).epsilon(0.001));
  CHECK(read(page(kSquare)).drawing.offPage == 0);
  // Twice the same place is lost once.
  const Shape twice = read(page("<path d='M-10 40h20v10h-20z'/><path d='M-10 40h20v10h-20z'/>"));
  CHECK(twice.drawing.offPage == doctest::Approx(100));
  CHECK(bounds(read(page("<rect x='-10' y='40' width='20' height='10'/>"), kOutlines)).min.x == -10);
  checkRefused(page("<rect x='-20' y='40' width='10' height='10'/>"), ErrorCode::EmptyShape,
               {"off the page", "ignore"});
}

TEST_CASE("clip paths leave what is inside of them") {
  const std::string big = "<rect width='90' height='90' clip-path='url(#c)'/>";
  const auto clip = [](const std::string& content, const std::string& attributes = "") {
    return "<clipPath id='c' " + attributes + ">" + content + "</clipPath>";
  };
  checkShown(clip(kSquare) + big, 100);
  checkShown(big + clip("<circle cx='50' cy='50' r='10' fill='none'/>"), std::numbers::pi * 100, 63);
  checkShown(clip(kSquare + "<rect x='15' y='10' width='10' height='10'/>") + big, 150);
  checkShown(clip(kSquare, "transform='scale(2)'") + big, 400);
  checkShown(clip("<rect x='.5' y='.5' width='.5' height='.5'/>", "clipPathUnits='objectBoundingBox'") +
                 "<g clip-path='url(#c)'><rect x='10' y='10' width='40' height='40'/></g>",
             400);
  checkShown(clip("<path d='M10 10h50v50h-50z M20 20h20v20h-20z' clip-rule='evenodd'/>") + big, 2500 - 400);
  checkShown(clip("<path d='M10 10h50v50h-50z M20 20h20v20h-20z' fill-rule='evenodd'/>") + big, 2500);
  checkShown(clip("<use href='#s'/>") + "<defs>" + "<rect id='s' x='10' y='10' width='10' height='10'/></defs>" + big,
             100);
  // One clip within another, on a group, in a style, and moved with the element.
  checkShown(clip(kSquare) +
                 "<clipPath id='d'><rect x='15' width='90' height='90'/></clipPath><g style='clip-path: "
                 "url(\"#d\")'>" +
                 big + "</g>",
             50);
  checkShown(clip(kSquare) + "<rect width='15' height='90' transform='translate(5 0)' clip-path='url(#c)'/>", 50);
  // Nothing in it, nothing left; without it, all.
  checkShown(clip("") + big + kSquare, 100);
  checkShown(big, 8100);
  checkRefused(page(clip("<rect width='5' height='5' clip-path='url(#c)'/>") + big), ErrorCode::InvalidFile,
               {"clip-path", "itself"});
}

TEST_CASE("many shapes under one rounded clip path are read at any size") {
  // All but one lie within; the last beside it.
  std::string squares;
  for (int i = 0; i < 2000; ++i) {
    squares += "<rect x='" + std::to_string(30 + i % 50) + "' y='" + std::to_string(30 + i / 50) +
               "' width='.5' height='.5'/>";
  }
  const std::string circle = "<clipPath id='c'><rect x='10' y='10' width='80' height='80' rx='40'/></clipPath>";
  const Shape inside = read(page(circle + "<g clip-path='url(#c)'>" + squares + kSquare + "</g>"), {.width = 400});
  CHECK(ringArea(inside) == doctest::Approx(16 * 500));
  const std::string ring =
      "<clipPath id='c'><path clip-rule='evenodd' d='M0 0H100V100H0zM30 0H60V100H30z'/></clipPath>";
  checkShown(ring + "<g clip-path='url(#c)'>" + squares + "</g>", 0.25 * 20 * 40);
  // What crosses straight borders keeps its fill rule.
  const std::string frame = "d='M10 10H50V50H10zM20 20H40V40H20z' fill-rule='evenodd'/>";
  checkShown("<svg x='15' width='15' height='90'><path transform='translate(-15)' " + frame + "</svg>",
             15 * 40 - 10 * 20);
}

TEST_CASE("masks show where they are painted, and not where the last paint is black") {
  const auto mask = [](const std::string& content, const std::string& attributes = "") {
    return "<mask id='m' " + attributes + ">" + content + "</mask><rect width='90' height='90' mask='url(#m)'/>";
  };
  checkShown(mask("<rect x='10' y='10' width='50' height='50' fill='white'/>"), 2500);
  checkShown(mask("<rect x='10' y='10' width='50' height='50' fill='#123'/>"), 2500);
  checkShown(mask("<rect x='10' y='10' width='50' height='50' fill='white'/>" + kSquare), 2400);
  checkShown(mask(kSquare + "<rect x='10' y='10' width='50' height='50' fill='white'/>"), 2500);
  checkShown(mask("<rect x='10' y='10' width='50' height='50' fill='white'/><rect x='20' y='20' width='20' height='20' "
                  "fill='black' opacity='.5'/>"),
             2500);
  checkShown(mask("<rect x='10' y='10' width='50' height='50' fill='white' stroke='black' stroke-width='10'/>"), 1600);
  checkShown(mask("<rect x='10' y='10' width='50' height='50'/>", "mask-type='alpha'"), 2500);
  checkShown(mask("<rect x='-10' y='-10' width='200' height='50' fill='white'/>",
                  "maskUnits='userSpaceOnUse' x='10' y='10' width='20' height='20'"),
             400);
  checkShown(mask("<rect width='.5' height='1' fill='white'/>", "maskContentUnits='objectBoundingBox'"), 4050);
  checkShown(kSquare + mask("<rect width='90' height='90'/>"), 100);
}

TEST_CASE("nested viewports cut off what overflows, unless it may") {
  const std::string body = "<rect width='30' height='30'/></svg>";
  checkShown("<svg x='10' y='10' width='20' height='20'>" + body, 400);
  checkShown("<svg x='10' y='10' width='20' height='20' overflow='visible'>" + body, 900);
  checkShown(
      "<symbol id='s' viewBox='0 0 10 10'><rect width='30' height='5'/></symbol><use href='#s' width='20' "
      "height='20'/>",
      200);
}

TEST_CASE("outlines that nearly or exactly cover each other have one border") {
  // Lines upon lines, at sizes where the grid of points puts them a little beside each other.
  const std::string drawing = page(
      "<g fill='none' stroke='red' stroke-width='8' stroke-linecap='round' stroke-linejoin='round'>"
      "<path d='M10 10l70 70'/><path d='M35 35l25 25'/><rect x='8' y='30' width='80' height='20'/>"
      "<path d='M48 30H31a10 10 0 0 1 0 -20C45 8 48 30 48 30z'/><path d='M48 80V30'/></g>");
  for (const double width : {100.0, 40.0, 41.3, 63.7, 127.1, 333.3}) {
    CAPTURE(width);
    const Shape shape = read(drawing, {.width = width});
    const Outline outline = resolveOutline(shape).value();
    const int rows = 20000;
    double area = 0;
    for (const auto& row : insideIntervals(shape, width / rows / 2, width / rows, rows)) {
      for (const Interval& interval : row) area += (interval.end - interval.begin) * width / rows;
    }
    CHECK(outline.area == doctest::Approx(area).epsilon(1e-4));
    std::map<std::pair<double, double>, int> open;
    for (const BorderSegment& s : outline.segments) {
      ++open[{s.a.x, s.a.y}];
      --open[{s.b.x, s.b.y}];
    }
    for (const auto& [point, balance] : open) CHECK(balance == 0);
  }
}

TEST_CASE("what lies off the page is told of paths that cross its edge as often as they like") {
  std::string once = "M-10 10H10V20H-10z", comb = "M-5 0";
  for (int i = 0; i < 200; ++i) comb += "v.1h10v.1h-10";
  CHECK(read(page("<path d='" + once + "'/>")).drawing.offPage == doctest::Approx(100));
  CHECK(read(page("<path d='" + once + once + "'/>")).drawing.offPage == doctest::Approx(100));
  CHECK(read(page("<path d='" + comb + "z'/>")).drawing.offPage == doctest::Approx(100));  // half of 5 x 40 mm2
  CHECK(read(page("<path d='M-10 -10H110V110H-10z'/>")).drawing.offPage == doctest::Approx(120 * 120 - 100 * 100));
}

TEST_CASE("hostile paint ends in a shape or an error, quickly") {
  const auto many = [](const std::string& piece, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += piece;
    return text;
  };
  checkRefused(page("<path d='M0 0H100' stroke='red' stroke-dasharray='0.0001 0.0001'/>" + many("<use href='#a'/>", 1) +
                    "<path id='a' d='M0 0" + many("h90h-90", 3000) + "' stroke='red' stroke-dasharray='.01'/>"),
               ErrorCode::TooLarge, {"points"});
  checkRefused(page("<clipPath id='c'><path d='M0 0" + many("l9 1l-8 1", 20000) +
                    "z'/></clipPath><g clip-path='url(#c)'>" + many("<rect width='90' height='9'/>", 5000) + "</g>"),
               ErrorCode::TooLarge, {"clip"});
  std::string nested = kSquare;
  for (int i = 0; i < 190; ++i) {
    nested = "<g clip-path='url(#k" + std::to_string(i) + ")'>" + nested + "</g><clipPath id='k" + std::to_string(i) +
             "' clipPathUnits='objectBoundingBox'><rect width='1' height='1'/></clipPath>";
    if (i == 90) break;
  }
  CHECK(readSvg(page(nested)).ok());
  CHECK(readSvg(page("<path d='M0 0h1e-9h1e-9h1e-9l1e-7 5' stroke='red' stroke-width='1e-9'/>" + kSquare)).ok());
  CHECK(
      readSvg(page("<path d='M0 0h9v9' stroke='red' stroke-width='1e-3' stroke-miterlimit='1e300'/>" + kSquare)).ok());
  CHECK(readSvg(page("<g transform='matrix(1 1 1 1 0 0)'><path d='M0 0h9v9' stroke='red'/></g>" + kSquare)).ok());
}
