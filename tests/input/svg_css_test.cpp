// What CSS says of an SVG drawing: which elements its rules mean, transforms, and what is told of the rest.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "input/svg.hpp"
#include "sillon/geometry/shape.hpp"

using namespace sillon;

namespace {

// A document of 100 x 100 mm with one user unit per mm.
Shape read(const std::string& body, const std::string& root = "viewBox='0 0 100 100'") {
  INFO(body);
  const Result<Shape> shape =
      readSvg("<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' " + root + ">" + body + "</svg>");
  if (!shape.ok()) FAIL(shape.error().message);
  return shape.value();
}

double areaOf(const Shape& shape) {
  const Result<Outline> outline = resolveOutline(shape);
  REQUIRE(outline.ok());
  return outline.value().area;
}

std::vector<std::string> unread(const std::string& body) { return read(body).drawing.unread; }

// Left, top, right, bottom, as SVG counts.
void checkBox(const Shape& shape, double left, double top, double right, double bottom) {
  const Bounds box = bounds(shape);
  CHECK(box.min.x == doctest::Approx(left));
  CHECK(100 - box.max.y == doctest::Approx(top));
  CHECK(box.max.x == doctest::Approx(right));
  CHECK(100 - box.min.y == doctest::Approx(bottom));
}

const std::string kDot = "<rect x='90' y='90' width='10' height='10'/>";  // 100 mm2, so that something is painted

}  // namespace

TEST_CASE("selectors mean elements by names, classes and ids, and by what they lie in") {
  const std::string tree =
      "<g id='top' class='a b'><g class='in'><rect id='r' class='x y' width='50' height='10'/></g></g>" + kDot;
  const auto hides = [&](const std::string& selector) {
    CAPTURE(selector);
    return areaOf(read("<style>" + selector + "{fill:none}</style>" + tree)) == doctest::Approx(100);
  };
  for (const char* fitting : {".x.y", ".y.x", "rect.x.y", "rect#r.y", "*.x", "g rect.x", "g .x", "#top .x", ".a.b .x",
                              ".b #r", "svg g g rect.x", "svg>g>g>rect.x", "g > .x", "svg > g .x", "#top > .in > .x",
                              "#top > * > #r", "svg * .x", "g\n>\n.x", "nothing, .in .x"}) {
    CHECK(hides(fitting));
  }
  for (const char* other : {".x.z", "circle.x", "#top.x", "g > g > g > .x", "#top > .x", "svg > .x", ".in .a .x",
                            ".x .x", "a .x", ".in > .a"}) {
    CHECK_FALSE(hides(other));
  }
  // A child of a child that lies deeper: the nearest element that fits is not the only one.
  CHECK(areaOf(read("<style>.p > .q .r{fill:none}</style><g class='p'><g class='q'><g class='q'><rect class='r' "
                    "width='50' height='10'/></g></g></g>" +
                    kDot)) == doctest::Approx(100));
}

TEST_CASE("the more specific rule wins, then the later one") {
  const auto shown = [](const std::string& rules) {
    return areaOf(read("<style>" + rules +
                       "</style><g id='g' class='a'><g><rect class='c d' width='50' height='10'/></g></g>" + kDot)) >
           100.5;
  };
  CHECK(shown("#g .c{fill:red} g g rect.c.d{fill:none}"));
  CHECK_FALSE(shown("#g .c{fill:none} g g rect.c.d{fill:red}"));
  CHECK(shown(".c.d{fill:red} g g g g g g g g g rect, svg g g rect{fill:none}"));
  CHECK(shown(".a .c{fill:none} .a .d{fill:red}"));
  CHECK_FALSE(shown(".a .d{fill:red} .a .c{fill:none}"));
  CHECK(shown(".a .c{fill:none} .c{fill:red!important}"));
}

TEST_CASE("rules that hold only in use are passed over, others that are not read are told") {
  for (const char* rules :
       {"rect:hover{fill:none}", "a:focus-within rect{fill:none}", "text[x]{font-size:3px}",
        "@font-face{font-family:x}", "@keyframes a{from{opacity:0}}", "@media print{text{font:x}}"}) {
    CAPTURE(rules);
    CHECK(unread("<style>" + std::string(rules) + "</style>" + kDot).empty());
    CHECK(areaOf(read("<style>" + std::string(rules) + "</style>" + kDot)) == doctest::Approx(100));
  }
  const std::vector<std::pair<std::string, std::string>> told{
      {"rect[x='1']{fill:none}", "CSS \"rect[x='1']\""},
      {"g, rect:nth-child(2){fill:none}", "CSS \"rect:nth-child(2)\""},
      {"g + rect{stroke-width:5}", "CSS \"g + rect\""},
      {"g ~ rect{opacity:0}", "CSS \"g ~ rect\""},
      {"g > > rect{opacity:0}", "CSS \"g > > rect\""},
      {"rect >{opacity:0}", "CSS \"rect >\""},
      {"@media (min-width: 1px) { rect { fill: none } }", "CSS \"@media\""},
      {"g { fill: red; rect { fill: none } }", "CSS \"nested rules\""}};
  for (const auto& one : told) {
    CAPTURE(one.first);
    CHECK(unread("<style><![CDATA[" + one.first + "]]></style>" + kDot) == std::vector<std::string>{one.second});
  }
}

TEST_CASE("style sheets of other languages are passed over, and those for other media told") {
  for (const char* applies : {"", "type='text/css'", "type='TEXT/CSS'", "media='all'", "media='print, Screen'"}) {
    CAPTURE(applies);
    CHECK(areaOf(read("<style " + std::string(applies) + ">rect{fill:none}</style><rect width='9' height='9'/>" +
                      "<path d='M9 9h10v10h-10z'/>")) == doctest::Approx(100));
  }
  const std::string rule = ">rect{fill:none}</style>" + kDot;
  CHECK(areaOf(read("<style type='text/plain'" + rule)) == doctest::Approx(100));
  CHECK(unread("<style type='text/plain'" + rule).empty());
  CHECK(areaOf(read("<style media='print'" + rule)) == doctest::Approx(100));
  CHECK(unread("<style media='print'" + rule) == std::vector<std::string>{"CSS \"@media\""});
  CHECK(unread("<style media='print'>text{font-size:9px}</style>" + kDot).empty());
}

TEST_CASE("what viewers show and is not read is told, once each, where it is shown") {
  const std::string defs =
      "<defs><marker id='m'/><filter id='f'/><pattern id='p'/><linearGradient id='l'/></defs>" + kDot;
  const auto note = [&](const std::string& body) {
    const std::vector<std::string> notes = unread(defs + body);
    REQUIRE(notes.size() <= 1);
    return notes.empty() ? std::string() : notes[0];
  };
  const std::string line = "<path stroke='red' d='M1 1h50v50' ";
  CHECK(note(line + "marker-end='url(#m)'/>" + line + "style='marker-mid:url(#m)'/>") == "<marker>");
  CHECK(note("<g style='marker:url(#m)'>" + line + "/></g>") == "<marker>");
  CHECK(note(line + "marker-end='url(#nothing)'/>").empty());
  CHECK(note(line + "filter='url(#f)'/>") == "<filter>");
  CHECK(note(line + "style='filter:blur(5px)'/>") == "<filter>");
  CHECK(note(line + "filter='none'/>").empty());
  CHECK(note(line + "fill='url(#p)'/>") == "<pattern>");
  CHECK(note("<g stroke='url(#p)'><path d='M1 1h50'/></g>") == "<pattern>");
  CHECK(note(line + "fill='url(#l)'/>").empty());
  CHECK(note("<foreignObject width='9' height='9'/>") == "<foreignObject>");
  CHECK(note("<switch><foreignObject requiredExtensions='x'/><g/></switch>").empty());
  CHECK(note(line + "stroke-dasharray='1 1' pathLength='9'/>") == "pathLength");
  CHECK(note(line + "pathLength='9'/>").empty());
  const std::string animate = "<animate attributeName='width' to='50' dur='1s'/>";
  CHECK(note("<rect width='9' height='9'>" + animate + animate + "</rect>") == "animation");
  CHECK(note("<g visibility='hidden'><set attributeName='visibility' to='visible'/></g>") == "animation");
  CHECK(note("<style>rect{animation:a 1s}</style>") == "animation");
  CHECK(note("<g style='animation-name:a'/>") == "animation");
  CHECK(note("<g style='animation:none'/>").empty());
  CHECK(note("<circle r='5' style='clip-path:circle(3px)'/>") == "CSS \"clip-path\"");
  CHECK(note("<circle r='5' clip-path='inset(1px)'/>") == "CSS \"clip-path\"");
  CHECK(note("<circle r='5' style='mask:linear-gradient(red,blue)'/>") == "CSS \"mask\"");
  CHECK(note("<circle r='5' mask='url(#nothing)' clip-path='none'/>").empty());
  CHECK(note("<circle r='5' style='r:9px'/>") == "CSS \"r\"");
  CHECK(note("<style>rect{width:50px}</style>") == "CSS \"width\"");
  for (const std::string moves : {"rotate:45deg", "translate:5px 9px", "scale:2", "offset-path:path('M0 0h9')"}) {
    const std::string name = moves.substr(0, moves.find(':'));
    CHECK(note("<g style=\"" + moves + "\"/>") == "CSS \"" + name + "\"");
    CHECK(note("<g style='" + name + ":none'/>").empty());
  }
  CHECK(note("<g style='width:50px'/>").empty());
  CHECK(note("<g style='transform:translateZ(0)'/>") == "transform \"translateZ(0)\"");
  CHECK(note("<g style='transform:rotate(1furlong)'/>") == "transform \"rotate(1furlong)\"");
  // What is not shown needs no note.
  CHECK(note("<g display='none'>" + line + "filter='url(#f)'/></g>").empty());
  CHECK(note("<g visibility='hidden'>" + line + "filter='url(#f)' fill='url(#p)'/></g>").empty());
  CHECK(note("<defs>" + line + "filter='url(#f)'/></defs>").empty());
  CHECK(read(kDot, "viewBox='0 0 100 100' style='width:100%'").drawing.unread.empty());
  CHECK(unread(defs + line + "filter='url(#f)' fill='url(#p)' marker-end='url(#m)'/>") ==
        std::vector<std::string>{"<marker>", "<filter>", "<pattern>"});
}

TEST_CASE("what masks and clip paths hold and is not read is told once") {
  const auto notes = [](const std::string& inside) {
    const std::string twice =
        "<rect width='50' height='10' mask='url(#m)'/><g clip-path='url(#m)'>" + kDot + "</g>" + kDot;
    std::vector<std::string> both;
    for (const char* kind : {"mask", "clipPath"}) {
      const std::string name = kind;
      const Shape shape =
          read("<filter id='f'/><marker id='k'/><" + name + " id='m'>" + inside + "</" + name + ">" + twice + twice);
      CHECK(shape.drawing.texts + shape.drawing.images == 0);
      REQUIRE(shape.drawing.unread.size() <= 1);
      both.push_back(shape.drawing.unread.empty() ? "" : shape.drawing.unread[0]);
    }
    return both;
  };
  using Notes = std::vector<std::string>;
  const std::string attributes = "width='9' height='9' fill='white' stroke='red'";
  CHECK(notes("<text>A</text>") == Notes{"<text>", "<text>"});
  CHECK(notes("<image width='9' height='9'/>") == Notes{"<image>", ""});  // no clip path shows one
  CHECK(notes("<rect filter='url(#f)' " + attributes + "/>") == Notes{"<filter>", ""});
  CHECK(notes("<path d='M1 1h9v9' marker-end='url(#k)'/>") == Notes{"<marker>", ""});
  CHECK(notes("<circle r='5' style='r:9px'/>") == Notes{"CSS \"r\"", "CSS \"r\""});
  CHECK(notes("<rect " + attributes + "/>") == Notes{"", ""});
  CHECK(notes("<text visibility='hidden'>A</text>") == Notes{"", ""});
}

TEST_CASE("a switch shows its first child that any reader, or one of English, may see") {
  const std::string children = "<g systemLanguage='de'><rect width='50' height='10'/></g>";
  CHECK(areaOf(read("<switch>" + children + kDot + "</switch>")) == doctest::Approx(100));
  CHECK(areaOf(read("<switch>" + children + "<g systemLanguage='fr, en-GB'>" + kDot +
                    "</g><rect width='50' height='50'/></switch>")) == doctest::Approx(100));
  CHECK(areaOf(read("<switch><g systemLanguage='enm'/>" + kDot + "</switch>")) == doctest::Approx(100));
  // Outside of a switch, each element is asked by itself.
  CHECK(areaOf(read(children + "<g systemLanguage='en'>" + kDot + "</g>")) == doctest::Approx(100));
  CHECK(areaOf(read("<rect requiredExtensions='http://x' width='50' height='10'/>" + kDot)) == doctest::Approx(100));
  CHECK(unread("<foreignObject requiredExtensions='http://x'/>" + kDot).empty());
}

TEST_CASE("CSS transforms take units, win over the attribute, and turn about their origin") {
  const auto box = [](const std::string& attributes, double left, double top, double right, double bottom) {
    CAPTURE(attributes);
    checkBox(read("<rect x='20' y='10' width='20' height='30' " + attributes + "/>"), left, top, right, bottom);
  };
  box("style='transform:translate(10px, 20%)'", 30, 30, 50, 60);
  box("style='transform:translateX(1px) translateY(50%)'", 21, 60, 41, 90);
  box("style='transform:scale(50%)'", 10, 5, 20, 20);
  box("style='transform:scaleX(.5) scaleY(2)'", 10, 20, 20, 80);
  box("style='transform:rotate(.25turn);transform-origin:40px 40px'", 40, 20, 70, 40);
  box("style='transform:rotate(100grad);transform-origin:40px 40px'", 40, 20, 70, 40);
  box("style='transform:rotate(1.5707963267948966rad);transform-origin:40% 40%'", 40, 20, 70, 40);
  box("style='transform:rotate(90deg);transform-box:fill-box;transform-origin:center'", 15, 15, 45, 35);
  box("style='transform:rotate(90deg);transform-box:fill-box;transform-origin:left bottom'", 20, 40, 50, 60);
  box("style='transform:rotate(90deg);transform-box:fill-box;transform-origin:100%'", 25, 5, 55, 25);
  box("style='transform:translate(100%,50%);transform-box:fill-box'", 40, 25, 60, 55);
  box("transform='scale(2)' style='transform:none'", 20, 10, 40, 40);
  box("transform='scale(2)' style='transform:translate(1px)'", 21, 10, 41, 40);
  box("transform='rotate(90)' transform-origin='40 40'", 40, 20, 70, 40);
  box("transform='rotate(90 40 40)'", 40, 20, 70, 40);
  box("style='transform:matrix(2,0,0,1,-20,0)'", 20, 10, 60, 40);
  // tan 45 deg = 1
  box("style='transform:skew(45deg,0deg)'", 30, 10, 80, 40);
  box("style='transform:skew(0,45deg)'", 20, 30, 40, 80);
  checkBox(read("<style>g{transform:translateX(10px)}</style><g><rect width='5' height='5'/></g>"), 10, 0, 15, 5);
  // The root is a box of CSS, which turns about its middle.
  checkBox(read("<rect width='20' height='10'/>", "viewBox='0 0 100 100' style='transform:rotate(90deg)'"), 90, 0, 100,
           20);
  CHECK_FALSE(
      readSvg("<svg width='9mm' height='9mm'><rect transform='rotate(90deg)' width='5' height='5'/></svg>").ok());
}

TEST_CASE("a stroke that does not scale is as wide as on the page") {
  // 10 pixels on a page of 96 pixels an inch.
  const Shape shape = read(
      "<line x1='1' x2='9' y1='5' y2='5' transform='scale(10)' stroke='red' stroke-width='10' "
      "vector-effect='non-scaling-stroke'/>");
  CHECK(areaOf(shape) == doctest::Approx(80 * 10 * 25.4 / 96));
  CHECK(areaOf(read("<g vector-effect='non-scaling-stroke'><line x1='1' x2='9' y1='5' y2='5' transform='scale(10)' "
                    "stroke='red' stroke-width='1'/></g>")) == doctest::Approx(800));
}

TEST_CASE("rules that would be compared for hours are refused") {
  std::string rules, elements;
  for (int k = 0; k < 4000; ++k) rules += ".a .b .c" + std::to_string(k) + " rect{fill:none}";
  for (int k = 0; k < 40000; ++k) elements += "<rect class='a b'/>";
  const Result<Shape> shape =
      readSvg("<svg width='9mm' height='9mm'><style>" + rules + "</style><g class='a b'>" + elements + "</g></svg>");
  REQUIRE_FALSE(shape.ok());
  CHECK(shape.error().code == ErrorCode::TooLarge);
  CHECK(shape.error().message.find("rules") != std::string::npos);
}

TEST_CASE("a paint that is no colour of CSS counts as missing, and initial paint is that of the root") {
  const auto area = [](const std::string& around, const std::string& declaration) {
    return areaOf(read("<g " + around + "><rect x='10' y='10' width='50' height='10' stroke-width='2' style='" +
                       declaration + "'/></g>" + kDot));
  };
  for (const char* missing : {"unset", "revert", "revert-layer", "inherit", "bogus", "#12", "#ggg", "12", "-"}) {
    CAPTURE(missing);
    CHECK(area("", std::string("stroke:") + missing) == doctest::Approx(600));
    CHECK(area("fill='none'", std::string("fill:") + missing) == doctest::Approx(100));
  }
  CHECK(area("stroke='red'", "stroke:initial") == doctest::Approx(600));
  CHECK(area("fill='none'", "fill:initial") == doctest::Approx(600));
  CHECK(area("fill='none'", "stroke:context-stroke") == doctest::Approx(100));
  CHECK(area("fill='none'", "fill:url(#nothing) bogus") == doctest::Approx(100));
  for (const char* colour : {"RebeccaPurple", "CanvasText", "#abcd", "#CD853F icc-color(a, 0.1)", "oklch(40% .2 30)",
                             "color-mix(in srgb, red, blue)", "url(#nothing) Teal", "rgb(1 2 3)"}) {
    CAPTURE(colour);
    CHECK(area("fill='none'", std::string("fill:") + colour) == doctest::Approx(600));
  }
}

TEST_CASE("elements are SVG's by their namespace, whatever prefixes a file gives them") {
  const auto area = [](const std::string& text) {
    const Result<Shape> shape = readSvg(text);
    if (!shape.ok()) FAIL(shape.error().message);
    return areaOf(shape.value());
  };
  const std::string size = " width='100mm' height='100mm' viewBox='0 0 100 100'";
  const std::string svg = "http://www.w3.org/2000/svg";
  CHECK(area("<n:svg xmlns:n='" + svg + "'" + size + "><n:rect width='5' height='2'/><rect width='9' height='9'/>" +
             "</n:svg>") == doctest::Approx(10));
  CHECK(area("<svg xmlns='" + svg + "' xmlns:q='http://www.w3.org/1999/xlink'" + size +
             "><defs><rect id='a' width='5' height='2'/></defs><use q:href='#a'/></svg>") == doctest::Approx(10));
  const std::string foreign = "<g xmlns='http://other'><rect width='9' height='9'/><s:path d='M9 9h1v1z'/></g>";
  CHECK(area("<svg xmlns='" + svg + "' xmlns:s='" + svg + "'" + size + ">" + foreign +
             "<x:rect xmlns:x='http://x' width='9' height='9'/><rect width='5' height='2'/></svg>") ==
        doctest::Approx(10));
  CHECK(area("<svg" + size + "><svg:rect width='5' height='2'/></svg>") == doctest::Approx(10));
  std::string many;
  for (int k = 0; k < 100; ++k) many += " xmlns:a" + std::to_string(k) + "='b'";
  CHECK(readSvg("<svg" + size + many + "><rect width='5' height='2'/></svg>").error().code == ErrorCode::TooLarge);
}

TEST_CASE("var() counts as its fallback, and what of var() and calc() is not read is told") {
  const auto rect = [](const std::string& declaration) {
    return read("<g fill='none'><rect x='10' y='10' width='50' height='10' style='" + declaration + "'/></g>" + kDot);
  };
  CHECK(areaOf(rect("fill:var(--a, red)")) == doctest::Approx(600));
  CHECK(areaOf(rect("fill:red;fill:var(--a,none)")) == doctest::Approx(100));
  CHECK(areaOf(rect("fill:var( --a , var(--b, rgb(1, 2, 3)))")) == doctest::Approx(600));
  CHECK(areaOf(rect("stroke:red;stroke-width:var(--a,2)")) == doctest::Approx(340));
  CHECK(areaOf(read("<rect width='50' height='10' fill='var(--a,none)'/>" + kDot)) == doctest::Approx(100));
  CHECK(rect("fill:var(--a, red)").drawing.unread.empty());
  // Where it is defined, the fallback may be another than what viewers show.
  CHECK(unread("<g style='--a:none'><rect width='50' height='10' style='fill:var(--a, red)'/></g>") ==
        std::vector<std::string>{"CSS \"var()\""});
  CHECK(unread("<style>:root{--a:none}</style>" + kDot).empty());
  CHECK(areaOf(rect("fill:var(--a)")) == doctest::Approx(100));
  CHECK(rect("fill:var(--a)").drawing.unread == std::vector<std::string>{"CSS \"var()\""});
  CHECK(rect("fill:var(--a, var(--b").drawing.unread == std::vector<std::string>{"CSS \"var()\""});
  const Shape calculated = rect("stroke:red;stroke-width:calc(2px * 10)");
  CHECK(areaOf(calculated) == doctest::Approx(220));
  CHECK(calculated.drawing.unread == std::vector<std::string>{"CSS \"calc()\""});
  std::string deep;
  for (int k = 0; k < 100000; ++k) deep += "var(--a,";
  CHECK(areaOf(rect("fill:" + deep)) == doctest::Approx(100));
}

TEST_CASE("a gradient is as opaque as its most opaque stop, and hides in a mask if all are black") {
  const auto area = [](const std::string& gradients, const std::string& fill = "url(#g)") {
    return areaOf(read(gradients + "<rect width='50' height='10' fill='" + fill + "'/>" + kDot));
  };
  const auto gradient = [](const std::string& inside) {
    return "<radialGradient id='g'>" + inside + "</radialGradient>";
  };
  // Below a fifth of its opacity nothing is seen: an ellipse of 10 by 2 in the middle.
  CHECK(area(gradient("<stop stop-opacity='0'/><stop offset='1' stop-opacity='.4'/>")) ==
        doctest::Approx(600 - 5 * std::numbers::pi).epsilon(1e-3));
  CHECK(area(gradient("<stop stop-opacity='0'/><stop stop-color='transparent'/>")) == doctest::Approx(100));
  CHECK(area(gradient("<stop style='stop-opacity:0'/>")) == doctest::Approx(100));
  CHECK(area(gradient("")) == doctest::Approx(100));
  const std::string next = "<linearGradient id='g' href='#h'/><linearGradient id='h' xlink:href='";
  CHECK(area(next + "'><stop stop-opacity='0'/></linearGradient>") == doctest::Approx(100));
  CHECK(area(next + "'><stop/></linearGradient>") == doctest::Approx(600));
  CHECK(area(next + "#g'/>") == doctest::Approx(100));
  CHECK(area("", "url(other.svg#g)") == doctest::Approx(100));
  CHECK(area("", "url(other.svg#g) red") == doctest::Approx(600));
  CHECK(read(gradient("<stop stop-opacity='.3'/>") + "<rect width='50' height='10' fill='url(#g)'/>" + kDot)
            .drawing.faintMm2 == doctest::Approx(500));

  const auto masked = [&](const std::string& stops) {
    return read(gradient(stops) +
                "<mask id='m'><rect width='50' height='50' fill='white'/><rect width='50' height='10' "
                "fill='url(#g)'/></mask><rect width='50' height='20' mask='url(#m)'/>");
  };
  const Shape hidden = masked("<stop/><stop offset='1' stop-color='#000'/>");
  CHECK(areaOf(hidden) == doctest::Approx(500));
  CHECK(hidden.drawing.unread.empty());
  const Shape graded = masked("<stop/><stop offset='1' stop-color='white'/>");
  CHECK(areaOf(graded) == doctest::Approx(1000));
  CHECK(graded.drawing.unread == std::vector<std::string>{"gradient in <mask>"});
}
