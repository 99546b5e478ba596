// Text of drawings, in letters that are boxes: 500 of 1000 wide, 700 high, 600 from one to the next. The font's small
// letters are 400 high, and it reaches from 300 below the base line to 900 above it.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "input/shaped_line.hpp"
#include "input/svg.hpp"
#include "sillon/geometry/shape.hpp"

using namespace sillon;

namespace {

struct Asked {
  std::string families;
  std::string line;

  friend bool operator==(const Asked&, const Asked&) = default;
};

Shape read(const std::string& content, std::vector<Asked>* asked = nullptr, const std::string& root = "") {
  SvgOptions options;
  options.letters.choose = [](std::string_view families) {
    return DrawingFont{std::string(families), families == "Other"};
  };
  options.letters.shape = [asked](const DrawingFont& font, const std::string& line) -> Result<ShapedLine> {
    if (asked != nullptr) asked->push_back({font.name, line});
    if (line.find('?') != std::string::npos) return Error{ErrorCode::InvalidArgument, "no such letter"};
    ShapedLine shaped;
    shaped.capHeight = 700;
    shaped.xHeight = 400;
    shaped.ascent = 900;
    shaped.descent = 300;
    shaped.instead = font.instead;
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
}

TEST_CASE("parts of a text follow one another, or begin at a place of their own") {
  checkPlaces("<text x='10' y='50'>a<tspan font-size='20'>b</tspan>c</text>", {{10, 50}, {16, 50}, {28, 50}});
  checkPlaces("<text x='10' y='50'>a<tspan dy='4'>b</tspan>c</text>", {{10, 50}, {16, 54}, {22, 54}});
  checkPlaces("<text x='10' y='20'>a<tspan x='30' y='40'>b</tspan></text>", {{10, 20}, {30, 40}});
  // Each line has its middle at its own place; the space behind the first one counts, as in browsers.
  checkPlaces("<text text-anchor='middle'><tspan x='20' y='20'>a</tspan>\n <tspan x='50' y='40'>bc</tspan></text>",
              {{14, 20}, {44, 40}, {50, 40}});
  checkPlaces("<text x='10 30 50' y='20'>abcd</text>", {{10, 20}, {30, 20}, {50, 20}, {56, 20}});
  checkPlaces("<text y='20'><tspan>a</tspan> <tspan>b</tspan><tspan>c</tspan></text>", {{0, 20}, {12, 20}, {18, 20}});
}

TEST_CASE("each attribute stands for itself, and an element has it from those around it") {
  checkPlaces("<text x='50' y='22'><tspan x='50'>a</tspan><tspan x='50' dy='24'>b</tspan></text>",
              {{50, 22}, {50, 46}});
  checkPlaces("<text x='20'><tspan y='34'>a</tspan></text>", {{20, 34}});
  checkPlaces("<text x='10' y='20'>a<tspan y='30'>b</tspan><tspan x='40'>c</tspan></text>",
              {{10, 20}, {16, 30}, {40, 30}});
  checkPlaces("<text x='10 20 30 40' y='50'><tspan x='5'>ab</tspan>cd</text>", {{5, 50}, {20, 50}, {30, 50}, {40, 50}});
  checkPlaces("<text x='10' y='50' dx='5'><tspan dx='3'>ab</tspan></text>", {{13, 50}, {19, 50}});
  checkPlaces("<text x='10' y='50'><a x='20' dx='5'>b</a></text>", {{10, 50}});
}

TEST_CASE("each number of a list moves its letter") {
  checkPlaces("<text x='5' y='40' dx='0 8 8 8'>abcd</text>", {{5, 40}, {19, 40}, {33, 40}, {47, 40}});
  checkPlaces("<text x='5' y='40' dy='0,-5,5'>abcd</text>", {{5, 40}, {11, 35}, {17, 40}, {23, 40}});
  checkPlaces("<text x='10 30' y='50' dx='5 2'>abc</text>", {{15, 50}, {32, 50}, {38, 50}});
  // A list ends where its element does, spaces that show nothing have no number, and those that do have one.
  checkPlaces("<text x='10 20 30 40 60' y='50'>a<tspan dy='1 2 3'>bc</tspan>d  <tspan>e</tspan></text>",
              {{10, 50}, {20, 51}, {30, 53}, {40, 53}, {66, 53}});
  checkPlaces("<text x='10' y='50' dx='1 2 3'> a <tspan dx='7'> b</tspan></text>", {{11, 50}, {32, 50}});
  checkPlaces("<text x='10' y='50'>a<tspan x='30'> b</tspan></text>", {{10, 50}, {36, 50}});
  checkPlaces(
      "<text x='10 20' y='50'><tspan display='none'>zz</tspan>\xC3\xA4"
      "b</text>",
      {{10, 50}, {16, 50}, {20, 50}});
  CHECK(askedBy("<text y='9' dx='0 0 1 0'>abcd</text>") ==
        std::vector<Asked>{{"", "ab"}, {"", "cd"}, {"", "bc"}, {"", "b"}, {"", "c"}});  // kerned as a pair
}

TEST_CASE("letters turn about their places, and the last angle goes on") {
  const std::vector<Bounds> turned =
      boxes(read("<text x='50' y='50' rotate='0 90'>ab<tspan rotate='0'>c</tspan>d</text>"));
  REQUIRE(turned.size() == 4);
  CHECK(turned[0].min == Vec2{50, 43});
  for (const std::size_t k : {1, 3}) {
    CAPTURE(k);
    CHECK(turned[k].min.x == doctest::Approx(50 + 6 * static_cast<double>(k)));
    CHECK(turned[k].max.x == doctest::Approx(57 + 6 * static_cast<double>(k)));
    CHECK(turned[k].min.y == doctest::Approx(50));
    CHECK(turned[k].max.y == doctest::Approx(55));
  }
  CHECK(turned[2].min.x == doctest::Approx(62));
}

TEST_CASE("lines have their anchor from where they begin, with all that is shifted in them") {
  checkPlaces("<text x='50' y='50' dx='5' text-anchor='middle'>ab</text>", {{49, 50}, {55, 50}});
  checkPlaces("<text x='50' y='50' dx='0 -20'>ab</text>", {{50, 50}, {64, 50}});
  checkPlaces(
      "<text x='50' y='50' text-anchor='middle'>a<tspan text-anchor='end'>b</tspan><tspan y='60' "
      "text-anchor='start'>c</tspan></text>",
      {{44, 50}, {50, 50}, {62, 60}});
}

TEST_CASE("letters hang from the lines of their font, or are raised above them") {
  const auto hangs = [](const char* line, double drop) {
    checkPlaces("<text x='10' y='50' dominant-baseline='" + std::string(line) + "'>a</text>", {{10, 50 + drop}});
    checkPlaces("<text x='10' y='50'>a<tspan alignment-baseline='" + std::string(line) + "'>b</tspan></text>",
                {{10, 50}, {16, 50 + drop}});
  };
  hangs("middle", 2);
  hangs("central", 3);
  hangs("hanging", 7.2);
  hangs("mathematical", 4.5);
  hangs("text-before-edge", 9);
  hangs("ideographic", -3);
  checkPlaces("<g dominant-baseline='middle'><text x='10' y='50'>a<tspan font-size='20'>b</tspan></text></g>",
              {{10, 52}, {16, 54}});
  checkPlaces(
      "<text x='10' y='50'>a<tspan baseline-shift='super'>b<tspan baseline-shift='sub' "
      "font-size='5'>c</tspan></tspan><tspan baseline-shift='10%'>d</tspan><tspan baseline-shift='3'>e</tspan></text>",
      {{10, 50}, {16, 44}, {22, 47}, {25, 49}, {31, 47}});
}

TEST_CASE("lines under, over and through letters") {
  const auto line = [](const char* decoration) {
    const std::vector<Bounds> found =
        boxes(read("<text x='10' y='50' style='text-decoration:" + std::string(decoration) +
                   "'> <tspan style='text-decoration:none'>a b</tspan></text>"));
    const auto widest = std::max_element(found.begin(), found.end(),
                                         [](const Bounds& a, const Bounds& b) { return a.size().x < b.size().x; });
    REQUIRE(found.size() == 3);
    CHECK(widest->min.x == doctest::Approx(10));
    CHECK(widest->max.x == doctest::Approx(28));
    CHECK(widest->size().y == doctest::Approx(1));
    return widest->min.y;
  };
  CHECK(line("underline") == doctest::Approx(50.5));
  CHECK(line("overline solid") == doctest::Approx(40));
  CHECK(line("line-through") == doctest::Approx(46.5));
}

TEST_CASE("letters stand on paths, each upright on the middle of its width") {
  // The path goes up at x = 50: letters 7 high lie to the left of it, the first of them 5 above its beginning.
  const std::string path = "<defs><path id='p' d='M50 90V50H20'/></defs>";
  const std::vector<Bounds> found =
      boxes(read(path + "<text><textPath href='#p' startOffset='5'>ab</textPath></text>"));
  REQUIRE(found.size() == 2);
  for (const Bounds& box : found) {
    CHECK(box.min.x == doctest::Approx(43));
    CHECK(box.max.x == doctest::Approx(50));
  }
  CHECK(std::max(found[0].max.y, found[1].max.y) == doctest::Approx(85));
  CHECK(std::min(found[0].min.y, found[1].min.y) == doctest::Approx(74));
  const auto count = [&](const std::string& inside) {
    return read(path + "<text>" + inside + "</text><rect width='9' height='9'/>").paths.size() - 1;
  };
  CHECK(count("<textPath href='#p'>" + std::string(11, 'a') + "</textPath>") == 11);
  CHECK(count("<textPath href='#p'>" + std::string(13, 'a') + "</textPath>") == 12);  // the path is 70 long
  CHECK(count("<textPath href='#p' startOffset='-9'>aa</textPath>") == 1);
  CHECK(count("<textPath path='M50 50H90'>aa</textPath>") == 2);
  CHECK(count("<textPath href='#none'>aa</textPath>") == 0);
}

TEST_CASE("letters are as long as textLength says, and slant") {
  checkPlaces("<text x='10' y='50' textLength='38'>abc</text>", {{10, 50}, {26, 50}, {42, 50}});
  const std::vector<Bounds> wide =
      boxes(read("<text x='10' y='50' textLength='36' lengthAdjust='spacingAndGlyphs'>abc</text>"));
  REQUIRE(wide.size() == 3);
  CHECK(wide[2].min.x == doctest::Approx(34));
  CHECK(wide[2].size().x == doctest::Approx(10));
  const std::vector<Bounds> slanted = boxes(read("<text x='10' y='50' font-style='italic'>a</text>"));
  CHECK(slanted[0].min.x == doctest::Approx(10));
  CHECK(slanted[0].max.x == doctest::Approx(15 + 7 * 0.25));
  CHECK(boxes(read("<g font-style='oblique'><text y='50' style='font:10px A'>a</text></g>"))[0].size().x ==
        doctest::Approx(5));
}

TEST_CASE("white space is one space, unless it is to be kept") {
  CHECK(askedBy("<text y='20'>  a \n\t b  </text>") == std::vector<Asked>{{"", "a b"}});
  CHECK(askedBy("<text y='20' xml:space='preserve'>a  b</text>") == std::vector<Asked>{{"", "a  b"}});
  CHECK(askedBy(
            "<g style='white-space:pre'><text y='20'>a \t<tspan style='white-space:normal'>b  c</tspan></text></g>") ==
        std::vector<Asked>{{"", "a  "}, {"", "b c"}});
  // Between tags, too.
  checkPlaces("<text y='20'>a<tspan> </tspan>b<tspan><tspan>c</tspan>\n</tspan>d</text>",
              {{0, 20}, {12, 20}, {18, 20}, {30, 20}});
  CHECK(askedBy("<text y='20' xml:space='preserve'><tspan>  </tspan><tspan>a</tspan></text>") ==
        std::vector<Asked>{{"", "  "}, {"", "a"}});
  CHECK(askedBy("<svg:text xmlns:svg='http://www.w3.org/2000/svg' y='20'>a<svg:tspan>\n</svg:tspan>b</svg:text>") ==
        std::vector<Asked>{{"", "a"}, {"", " "}, {"", "b"}});
}

TEST_CASE("words are spaced, and letters are in capitals, as styles say") {
  checkPlaces("<text x='10' y='50' word-spacing='5'>a b\xC2\xA0 c</text>",
              {{10, 50}, {27, 50}, {33, 50}, {39, 50}, {61, 50}});
  checkPlaces("<text x='90' y='50' word-spacing='.5em' letter-spacing='.1em' text-anchor='end'>a b</text>",
              {{64, 50}, {83, 50}});
  CHECK(askedBy("<text y='20' style='text-transform:uppercase'>a\xC3\xA4\xD0\xB6\xD1\x91 1</text>") ==
        std::vector<Asked>{{"", "A\xC3\x84\xD0\x96\xD0\x81 1"}});
  CHECK(askedBy("<text y='20' style='text-transform:lowercase'>A\xC3\x84\xD0\x96\xD0\x81\xC3\x97</text>") ==
        std::vector<Asked>{{"", "a\xC3\xA4\xD0\xB6\xD1\x91\xC3\x97"}});
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
  checkPlaces(
      "<g font-size='2px'><text y='1em' font-size='20'>a<tspan font-size='0'>bb</tspan><tspan "
      "font-size='large'>c</tspan></text></g>",
      {{0, 20}, {12, 20}});
  CHECK(boxes(read("<text y='50' font-size='xx-large'>a</text>"))[0].size().y == doctest::Approx(0.7 * 32));
  CHECK(boxes(read("<text y='20' style='font:larger A'>a</text>"))[0].size().y == doctest::Approx(0.7 * 12));
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
  CHECK(facts("<flowRoot>a</flowRoot>").texts == 1);
  CHECK(facts("<text y='20' textLength='50'><tspan textLength='9'>ok</tspan></text>").unread ==
        std::vector<std::string>{"textLength"});
}

TEST_CASE("what changes or moves letters and is not read is told") {
  const auto unread = [](const std::string& text) { return read(text).drawing.unread; };
  using Names = std::vector<std::string>;
  for (const char* css : {"font-weight:300", "font-variant:small-caps", "font-stretch:condensed", "direction:rtl",
                          "writing-mode:tb", "text-transform:capitalize", "text-shadow:1px 1px #000",
                          "font-feature-settings:'smcp'", "unicode-bidi:bidi-override"}) {
    CAPTURE(css);
    const std::string style = css, name = style.substr(0, style.find(':'));
    CHECK(unread("<text y='20' style=\"" + style + "\">ok</text>") == Names{name});
    CHECK(unread("<g style=\"" + style + "\"><text y='20'><tspan>ok</tspan></text></g>") == Names{name});
    CHECK(unread("<g style=\"" + style + "\"><text y='20' style='" + name + ":normal'>ok</text></g>").empty());
    CHECK(unread("<g style=\"" + style + "\"><rect width='9' height='9'/></g>").empty());
  }
  CHECK(unread("<text y='20' style='font:italic 300 10px A'>ok</text>") == Names{"font-weight"});
  CHECK(unread("<text y='20' font-weight='bold'>ok</text>").empty());
  CHECK(unread("<g font-weight='300'><text y='20' style='font:10px A'>ok</text></g>").empty());
  CHECK(unread("<text y='20' style='text-decoration:underline wavy'>ok</text>") == Names{"text-decoration-style"});
  CHECK(unread("<text y='20' style='text-transform:uppercase'>\xC3\x9F</text>") == Names{"text-transform"});
  CHECK(unread("<text y='20' style='font-style:normal;font-variant-ligatures:normal;font-weight:400;direction:ltr;"
               "writing-mode:lr-tb;text-decoration:none;text-transform:none'>ok</text>")
            .empty());
  CHECK(unread("<style>text:first-child{font-size:20px}</style><text y='20'>ok</text>") ==
        Names{"CSS \"text:first-child\""});
  CHECK(unread("<style>text:first-child{font-size:20px}</style><rect width='9' height='9'/>").empty());
}

TEST_CASE("letters without measure are refused before one of them is shaped") {
  const auto most = [](int letters, const std::string& more = "") {
    SvgOptions options;
    int shaped = 0;
    options.letters.shape = [&](const DrawingFont&, const std::string& line) -> Result<ShapedLine> {
      shaped += static_cast<int>(line.size());
      ShapedLine out;
      out.outlines = {"M0 0H500V700H0Z"};
      out.letters.assign(line.size(), {0, {}, 600});
      return out;
    };
    const auto shape = readSvg("<svg width='9mm' height='9mm'><text y='5' font-size='.0001'>" +
                                   std::string(static_cast<std::size_t>(letters), 'a') + "</text>" + more + "</svg>",
                               options);
    if (!shape.ok()) CHECK(shape.error().message.find("more than 100000 letters") != std::string::npos);
    CHECK(shaped == (shape.ok() || !more.empty() ? letters : 0));
    return shape.ok();
  };
  CHECK(most(100'000));
  CHECK_FALSE(most(100'001));
  CHECK_FALSE(most(60'000, "<text>" + std::string(40'001, 'b') + "</text>"));
}

TEST_CASE("broken places are refused, and letters without measure too") {
  const auto refused = [](const std::string& content) {
    SvgOptions options;
    options.letters.shape = [](const DrawingFont&, const std::string& line) -> Result<ShapedLine> {
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
