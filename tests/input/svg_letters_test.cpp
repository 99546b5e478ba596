// Text of drawings, in letters that are boxes: 500 of 1000 wide, 700 high, 600 from one to the next.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "input/svg.hpp"
#include "sillon/geometry/outline.hpp"

using namespace sillon;

namespace {

struct Asked {
  std::string families;
  std::string line;

  friend bool operator==(const Asked&, const Asked&) = default;
};

Shape read(const std::string& content, std::vector<Asked>* asked = nullptr, const std::string& root = "") {
  SvgOptions options;
  options.letters = [asked](const std::string& families, const std::string& line) -> Result<ShapedLine> {
    if (asked != nullptr) asked->push_back({families, line});
    if (line.find('?') != std::string::npos) return Error{ErrorCode::InvalidArgument, "no such letter"};
    ShapedLine shaped;
    shaped.capHeight = 700;
    shaped.instead = families == "Other";
    shaped.outlines = {"M0 0H500V700H0Z", ""};
    for (const char c : line) shaped.letters.push_back({c == ' ' ? std::size_t{1} : 0, {}, 600});
    return shaped;
  };
  const Result<Shape> shape = readSvg(
      "<svg width='100mm' height='100mm' viewBox='0 0 100 100' font-size='10' " + root + ">" + content + "</svg>",
      options);
  REQUIRE_MESSAGE(shape.ok(), (shape.ok() ? "" : shape.error().message));
  return shape.value();
}

/// The boxes of the letters from the left, y down as in the drawing.
std::vector<Bounds> boxes(const Shape& shape) {
  std::vector<Bounds> all;
  for (const FilledPath& path : shape.paths) {
    Bounds box;
    for (const Ring& ring : path.rings) {
      for (const Vec2 point : ring) box.add({point.x, 100 - point.y});
    }
    all.push_back(box);
  }
  std::sort(all.begin(), all.end(), [](const Bounds& a, const Bounds& b) { return a.min.x < b.min.x; });
  return all;
}

/// Lower left corners of the letters.
std::vector<Vec2> places(const std::string& content, const std::string& root = "") {
  std::vector<Vec2> all;
  for (const Bounds& box : boxes(read(content, nullptr, root))) all.push_back({box.min.x, box.max.y});
  return all;
}

void checkPlaces(const std::string& content, const std::vector<Vec2>& expected) {
  CAPTURE(content);
  const std::vector<Vec2> found = places(content);
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    CHECK(found[k].x == doctest::Approx(expected[k].x));
    CHECK(found[k].y == doctest::Approx(expected[k].y));
  }
}

std::vector<Asked> askedBy(const std::string& content) {
  std::vector<Asked> asked;
  read(content, &asked);
  return asked;
}

}  // namespace

TEST_CASE("letters stand on the line, one behind the other") {
  const std::vector<Bounds> found = boxes(read("<text x='10' y='50'>ab</text>"));
  REQUIRE(found.size() == 2);
  CHECK(found[0].min == Vec2{10, 43});
  CHECK(found[0].max == Vec2{15, 50});
  CHECK(found[1].min == Vec2{16, 43});
  checkPlaces("<text x='10' y='50' font-size='20'>ab</text>", {{10, 50}, {22, 50}});
  checkPlaces("<g transform='translate(5 5)'><text y='20'>a</text></g>", {{5, 25}});
  checkPlaces("<text x='10%' y='1in'>a</text>", {{10, 96}});
}

TEST_CASE("anchors, shifts, spacing and base lines") {
  checkPlaces("<text x='50' y='50' text-anchor='middle'>ab</text>", {{44, 50}, {50, 50}});
  checkPlaces("<text x='50' y='50' style='text-anchor:end'>ab</text>", {{38, 50}, {44, 50}});
  checkPlaces("<text x='10' y='50' dx='2' dy='-3'>a</text>", {{12, 47}});
  checkPlaces("<text x='10' y='50' letter-spacing='1'>ab</text>", {{10, 50}, {17, 50}});
  checkPlaces("<text x='10' y='50' dominant-baseline='middle'>a</text>", {{10, 53.5}});
  checkPlaces("<text x='10' y='50' dominant-baseline='hanging'>a</text>", {{10, 57}});
}

TEST_CASE("parts of a text follow one another, or begin at a place of their own") {
  checkPlaces("<text x='10' y='50'>a<tspan font-size='20'>b</tspan>c</text>", {{10, 50}, {16, 50}, {28, 50}});
  checkPlaces("<text x='10' y='50'>a<tspan dy='4'>b</tspan>c</text>", {{10, 50}, {16, 54}, {22, 54}});
  checkPlaces("<text x='10' y='20'>a<tspan x='30' y='40'>b</tspan></text>", {{10, 20}, {30, 40}});
  // Each line has its middle at its own place, whatever stands between the elements.
  checkPlaces("<text text-anchor='middle'><tspan x='20' y='20'>a</tspan>\n <tspan x='50' y='40'>bc</tspan></text>",
              {{17, 20}, {44, 40}, {50, 40}});
  checkPlaces("<text x='10 30 50' y='20'>abcd</text>", {{10, 20}, {30, 20}, {50, 20}, {56, 20}});
  checkPlaces("<text y='20'><tspan>a</tspan> <tspan>b</tspan><tspan>c</tspan></text>", {{0, 20}, {12, 20}, {18, 20}});
}

TEST_CASE("white space is one space, unless it is to be kept") {
  CHECK(askedBy("<text y='20'>  a \n\t b  </text>") == std::vector<Asked>{{"", "a b"}});
  CHECK(askedBy("<text y='20' xml:space='preserve'>a  b</text>") == std::vector<Asked>{{"", "a  b"}});
}

TEST_CASE("sizes and families come from attributes, styles and the shorthand") {
  checkPlaces(
      "<g style='font-size:20px'><text y='20'>a<tspan style='font-size:50%'>b</tspan><tspan "
      "style='font-size:2em'>c</tspan></text></g>",
      {{0, 20}, {12, 20}, {18, 20}});
  checkPlaces("<style>.t{font:italic 700 20px/1.2 \"A B\", serif}</style><text y='20' class='t'>ab</text>",
              {{0, 20}, {12, 20}});
  CHECK(askedBy("<style>.t{font:italic 700 20px/1.2 \"A B\", serif}</style><text y='20' class='t'>a</text>") ==
        std::vector<Asked>{{"\"A B\", serif", "a"}});
  CHECK(askedBy("<g font-family='One'><text y='20'>a<tspan font-family='Two'>b</tspan></text></g>") ==
        std::vector<Asked>{{"One", "a"}, {"Two", "b"}});
  CHECK(read("<text y='20' font-family='Other'>a</text>").drawing.otherFont);
  CHECK_FALSE(read("<text y='20'>a</text>").drawing.otherFont);
}

TEST_CASE("letters are painted, clip and mask as shapes do") {
  CHECK(boxes(read("<rect width='5' height='5'/><text y='20'>a<tspan visibility='hidden'>b</tspan><tspan "
                   "display='none'>c</tspan><tspan fill='none'>d</tspan></text>"))
            .size() == 2);
  // A stroke of 2 reaches 1 beyond the box.
  const std::vector<Bounds> stroked =
      boxes(read("<text x='10' y='50' fill='none' stroke='#000' stroke-width='2'>a</text>"));
  REQUIRE(stroked.size() == 1);
  CHECK(stroked[0].min.x == doctest::Approx(9));
  CHECK(stroked[0].max.y == doctest::Approx(51));
  const auto area = [](const Shape& shape) { return resolveOutline(shape).value().area; };
  CHECK(area(read("<clipPath id='c'><text x='10' y='50'>a</text></clipPath><rect width='90' height='90' "
                  "clip-path='url(#c)'/>")) == doctest::Approx(35));
  CHECK(area(read("<mask id='m'><rect width='99' height='99' fill='#fff'/><text x='10' y='50'>a</text></mask><rect "
                  "width='50' height='50' mask='url(#m)'/>")) == doctest::Approx(2500 - 35));
}

TEST_CASE("text that cannot be drawn is told as left out") {
  const auto facts = [](const std::string& text) { return read("<rect width='9' height='9'/>" + text).drawing; };
  CHECK(facts("<text y='20'>ok</text>").texts == 0);
  CHECK(facts("<text y='20'>what?</text><text y='20'>ok</text>").texts == 1);
  CHECK(facts("<path id='p' d='M0 0H9'/><text>a<textPath href='#p'>b</textPath></text>").texts == 1);
  CHECK(facts("<flowRoot>a</flowRoot>").texts == 1);
  CHECK(facts("<text y='20' textLength='50'>ok</text>").unread == std::vector<std::string>{"textLength"});
  CHECK(facts("<text y='20' rotate='50'>ok</text>").unread == std::vector<std::string>{"rotate"});
}

TEST_CASE("broken places are refused, and letters without measure too") {
  const auto refused = [](const std::string& content) {
    SvgOptions options;
    options.letters = [](const std::string&, const std::string& line) -> Result<ShapedLine> {
      ShapedLine shaped;
      shaped.outlines = {"M0 0H500V700H0Z"};
      shaped.letters.assign(line.size(), {0, {}, 600});
      return shaped;
    };
    const auto shape = readSvg("<svg width='9' height='9'>" + content + "</svg>", options);
    REQUIRE_FALSE(shape.ok());
    return shape.error();
  };
  CHECK(refused("<text x='1 two'>a</text>").message.find("x is \"1 two\"; it must be lengths") != std::string::npos);
  std::string laughs = "<g id='l0'><text y='5'>" + std::string(1000, 'a') + "</text></g>";
  for (int k = 1; k < 5; ++k) {
    laughs += "<g id='l" + std::to_string(k) + "'>";
    for (int use = 0; use < 10; ++use) laughs += "<use href='#l" + std::to_string(k - 1) + "'/>";
    laughs += "</g>";
  }
  CHECK(refused(laughs).code == ErrorCode::TooLarge);
}
