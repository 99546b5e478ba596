// Letters against another reader of fonts, closed forms of where they stand, and fonts that are broken or hostile.
#include "sillon/text/text.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "input/shaped_line.hpp"
#include "input/svg.hpp"
#include "sillon/geometry/shape.hpp"
#include "text/letters.hpp"
#include "text/qr_code.hpp"

#define STB_TRUETYPE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#include <stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

using namespace sillon;

namespace {

const ReadInput kNoFiles = [](const std::string& name, const std::string& /*what*/) -> Result<InputFile> {
  return Error{ErrorCode::InvalidFile, "no " + name};
};

std::string fontFile(const std::string& name) {
  std::ifstream in(SILLON_SOURCE_DIR "/core/data/fonts/" + name + ".ttf", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

double areaOf(const Shape& shape) { return resolveOutline(shape).value().area; }

/// Area of a text in font units, and the height of H, as stb_truetype reads them: Green's formula on each curve.
struct Expected {
  double area = 0;
  double capHeight = 0;
};

Expected expectedOf(const std::string& bytes, const std::u32string& text) {
  stbtt_fontinfo font;
  REQUIRE(stbtt_InitFont(&font, reinterpret_cast<const unsigned char*>(bytes.data()), 0) != 0);
  Expected expected;
  int left = 0, bottom = 0, right = 0, top = 0;
  stbtt_GetCodepointBox(&font, 'H', &left, &bottom, &right, &top);
  expected.capHeight = top - bottom;
  for (const char32_t letter : text) {
    stbtt_vertex* vertices = nullptr;
    const int count = stbtt_GetCodepointShape(&font, static_cast<int>(letter), &vertices);
    double area = 0;
    Vec2 at;
    for (int k = 0; k < count; ++k) {
      const stbtt_vertex& v = vertices[k];
      const Vec2 to{static_cast<double>(v.x), static_cast<double>(v.y)};
      const Vec2 control{static_cast<double>(v.cx), static_cast<double>(v.cy)};
      if (v.type == STBTT_vline) area += cross(at, to) / 2;
      if (v.type == STBTT_vcurve) {
        // The integral of x dy - y dx over a quadratic curve.
        area += (2 * cross(at, control) + 2 * cross(control, to) + cross(at, to)) / 6;
      }
      at = to;
    }
    expected.area += std::abs(area);
    stbtt_FreeShape(&font, vertices);
  }
  return expected;
}

}  // namespace

TEST_CASE("letters have the area that another reader finds in the font") {
  const std::vector<std::pair<std::string, std::string>> fonts{{"Nunito", "nunito"},
                                                               {"Bebas Neue", "bebas-neue"},
                                                               {"Roboto Slab", "roboto-slab"},
                                                               {"Fredoka", "fredoka"},
                                                               {"Caveat", "caveat"}};
  for (const auto& [name, file] : fonts) {
    const auto nameNow = name;  // clang 14 captures no structured binding
    CAPTURE(nameNow);
    const bool overlaps = name == "Caveat" || name == "Fredoka";  // of strokes within a letter: counted twice there
    const Expected expected = expectedOf(fontFile(file), U"Hamburgé 0123");
    Lettering lettering{"Hamburg\u00e9 0123", name, 20};
    const auto shape = textShape(lettering, kNoFiles);
    REQUIRE(shape.ok());
    const double scale = 20 / shapeLine(kNoFiles, name, "H").value().capHeight;
    CHECK(areaOf(shape.value()) == doctest::Approx(expected.area * scale * scale).epsilon(overlaps ? 0.03 : 0.005));
  }
}

TEST_CASE("capitals have the height that is asked for, and the page is the ink") {
  for (const std::string_view name : builtinFonts()) {
    const std::string font(name);
    CAPTURE(std::string(font));
    const auto shape = textShape({"H", font, 12.5}, kNoFiles);
    REQUIRE(shape.ok());
    const Bounds ink = bounds(shape.value());
    CHECK(ink.min == Vec2{0, 0});
    CHECK(ink.max == shape.value().page);
    CHECK(ink.size().y == doctest::Approx(12.5).epsilon(0.005));
  }
}

TEST_CASE("pairs are kerned, and lines stand as they are aligned") {
  const auto width = [](const char* text) { return textShape({text, "Nunito", 10}, kNoFiles).value().page.x; };
  CHECK(width("AVAVAV") < 0.97 * (width("AAA") + width("VVV")));
  const auto lines = [](TextAlign align) { return textShape({"HHHH\nH", "Nunito", 10, 0, align}, kNoFiles).value(); };
  const auto below = [&](TextAlign align) {
    Bounds low;
    const Shape shape = lines(align);
    for (const FilledPath& path : shape.paths) {
      for (const Ring& ring : path.rings) {
        for (const Vec2 point : ring) {
          if (point.y < 10.5) low.add(point);
        }
      }
    }
    return 0.5 * (low.min.x + low.max.x) / shape.page.x;
  };
  CHECK(lines(TextAlign::Left).page.y == doctest::Approx(10 + 17).epsilon(0.02));
  CHECK(below(TextAlign::Left) < 0.2);
  CHECK(below(TextAlign::Middle) == doctest::Approx(0.5).epsilon(0.01));
  CHECK(below(TextAlign::Right) > 0.8);
}

TEST_CASE("a number in a line that runs to the left is read from the left, and brackets open to the left") {
  const auto outlines = [](const char* text) {
    const ShapedLine line = shapeLine(kNoFiles, "Fredoka", text).value();
    std::vector<std::string> drawn;
    for (const ShapedLine::Letter& letter : line.letters) drawn.push_back(line.outlines[letter.outline]);
    return drawn;
  };
  const auto sum = [&](std::initializer_list<const char*> parts) {
    std::vector<std::string> all;
    for (const char* part : parts) {
      for (std::string& outline : outlines(part)) all.push_back(std::move(outline));
    }
    return all;
  };
  CHECK(outlines("\u05d0 12") == sum({"12", " ", "\u05d0"}));
  CHECK(outlines("\u05d0\t12") == sum({"12", " ", "\u05d0"}));
  CHECK(outlines("(12/5) \u05d0\u05d1") == sum({"\u05d1", "\u05d0", " ", "(12/5)"}));
  CHECK(outlines("\u05d0 (12:5) \u05d1") == sum({"\u05d1", " ", "(12:5)", " ", "\u05d0"}));
  CHECK(outlines("A (\u05d0\u05d1) 5!") == sum({"A (", "\u05d1", "\u05d0", ") 5!"}));
  CHECK(outlines("\u05d0 Ab \u05d1") == sum({"\u05d1", " ", "Ab", " ", "\u05d0"}));
}

TEST_CASE("a letter that a font lacks comes from the first built-in one that has it, at the same height") {
  const auto line = [](const std::string& font, const std::string& text) {
    return shapeLine(kNoFiles, font, text).value();
  };
  using Lacked = std::vector<LackedLetter>;
  const ShapedLine mixed = line("Caveat", "A \u05d0\u05d1 B");
  CHECK(mixed.lacked == Lacked{{"\u05d1", "Fredoka", false}, {"\u05d0", "Fredoka", false}});
  REQUIRE(mixed.letters.size() == 6);
  const ShapedLine own = line("Fredoka", "\u05d0\u05d1");
  const double scale = mixed.capHeight / own.capHeight;
  CHECK(std::abs(scale - 1) > 0.01);
  CHECK(mixed.letters[2].advance == own.letters[0].advance * scale);
  CHECK(mixed.letters[3].advance == own.letters[1].advance * scale);
  // A letter with a mark is one: both come from the font that has both.
  const ShapedLine marked = line("Nunito", "\u0395\u0301\u0395");
  CHECK(marked.lacked == Lacked{{"\u0395", "Roboto Slab", false}});

  // A letter that no font has is left out, and told once; a sign that is not seen is no letter.
  const ShapedLine lost = line("Nunito", "A\u5b57\u200dB\ufe0f\u5b57");
  CHECK(lost.letters.size() == 2);
  CHECK(lost.lacked == Lacked{{"\u5b57", "", false}});
  std::string many;
  for (const char* letter :
       {"\u5b50", "\u5b51", "\u5b52", "\u5b53", "\u5b54", "\u5b55", "\u5b56", "\u5b57", "\u5b58"}) {
    many += letter;
  }
  CHECK(line("Nunito", many + "\u05d0").lacked.size() == 8 + 1);
}

TEST_CASE("a letter of which a font has no outline is one that it lacks") {
  std::string bytes = fontFile("fredoka");
  stbtt_fontinfo font;
  REQUIRE(stbtt_InitFont(&font, reinterpret_cast<const unsigned char*>(bytes.data()), 0) != 0);
  // The outline of o ends where it begins.
  const int size = font.indexToLocFormat == 0 ? 2 : 4;
  const int at = font.loca + size * stbtt_FindGlyphIndex(&font, 'o');
  for (int k = 0; k < size; ++k)
    bytes[static_cast<std::size_t>(at + size + k)] = bytes[static_cast<std::size_t>(at + k)];
  const ReadInput read = [&](const std::string&, const std::string&) { return Result<InputFile>(InputFile(bytes)); };
  const ShapedLine line = shapeLine(read, "own.ttf", "Bo b").value();
  CHECK(line.lacked == std::vector<LackedLetter>{{"o", "Nunito", true}});
  CHECK(line.letters[1].advance ==
        doctest::Approx(shapeLine(kNoFiles, "Nunito", "o").value().letters[0].advance * line.capHeight /
                        shapeLine(kNoFiles, "Nunito", "o").value().capHeight));
}

TEST_CASE("a variable font is as heavy as asked") {
  std::ifstream file(SILLON_SOURCE_DIR "/tests/data/field/boxes-weight.ttf", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const ReadInput read = [&](const std::string&, const std::string&) { return Result<InputFile>(InputFile(bytes)); };
  // A bar of 100 units by 700, which grows to 500 between the weights of 100 and 900.
  for (const auto& [weight, width] : {std::pair(0, 100.0), {100, 100.0}, {500, 300.0}, {900, 500.0}, {1000, 500.0}}) {
    const auto weightNow = weight;  // clang 14 captures no structured binding
    CAPTURE(weightNow);
    Lettering lettering{"H", "own.ttf", 7};
    lettering.weight = weight;
    const auto shape = textShape(lettering, read);
    REQUIRE(shape.ok());
    CHECK(shape.value().page.x == doctest::Approx(width / 100));
    CHECK(shape.value().page.y == doctest::Approx(7));
  }
  Lettering plain{"H", "Nunito", 7}, heavy = plain;
  heavy.weight = 900;
  CHECK(textShape(plain, kNoFiles).value() == textShape(heavy, kNoFiles).value());
}

TEST_CASE("web fonts are the fonts inside them, or refused") {
  const auto fileOf = [](const std::string& name) {
    std::ifstream file(SILLON_SOURCE_DIR "/tests/fuzz/seeds/font/" + name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  };
  const auto shaped = [](const std::string& bytes) {
    const ReadInput read = [&](const std::string&, const std::string&) { return Result<InputFile>(InputFile(bytes)); };
    return textShape({"fiAV\u00c9H", "own", 7}, read);
  };
  const auto plain = shaped(fileOf("kerned.ttf"));
  REQUIRE(plain.ok());
  for (const char* name : {"kerned.woff", "kerned.woff2"}) {
    CAPTURE(name);
    const std::string bytes = fileOf(name);
    const auto packed = shaped(bytes);
    REQUIRE(packed.ok());
    CHECK(packed.value() == plain.value());
    for (std::size_t size = 4; size < bytes.size(); ++size) {
      const auto cut = shaped(bytes.substr(0, size));
      if (!cut) CHECK(cut.error().message.find("plain or packed") != std::string::npos);
    }
    CHECK_FALSE(shaped(bytes.substr(0, bytes.size() / 2)).ok());
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      std::string other = bytes;
      other[at] = static_cast<char>(~other[at]);
      (void)shaped(other);  // it ends
    }
  }
}

TEST_CASE("a letter of a font in colour is the union of its parts") {
  const auto outlineOf = [](const std::string& name) {
    std::ifstream file(SILLON_SOURCE_DIR "/tests/fuzz/seeds/font/" + name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const ReadInput read = [&](const std::string&, const std::string&) { return Result<InputFile>(InputFile(bytes)); };
    const ShapedLine line = shapeLine(read, "own.ttf", "H").value();
    CHECK(line.lacked.empty());
    return line.outlines.at(line.letters.at(0).outline);
  };
  const std::string bars =
      "M0.0 0.0 L0.0 700.0 L150.0 700.0 L150.0 0.0 L0.0 0.0 ZM450.0 0.0 L450.0 700.0 L600.0 700.0 L600.0 0.0 L450.0 "
      "0.0 "
      "ZM0.0 280.0 L0.0 420.0 L600.0 420.0 L600.0 280.0 L0.0 280.0 Z";
  CHECK(outlineOf("layers.ttf") == bars);
  // A square of 100 units, half as high again and moved.
  CHECK(outlineOf("painted.ttf") == bars + "M250.0 500.0 L250.0 650.0 L350.0 650.0 L350.0 500.0 L250.0 500.0 Z");
}

TEST_CASE("a name that is no font's is refused with those that there are") {
  for (const char* name : {"Arial", "nunito"}) {
    const auto line = shapeLine(kNoFiles, name, "A");
    REQUIRE_FALSE(line.ok());
    for (const std::string_view font : builtinFonts()) CHECK(line.error().message.find(font) != std::string::npos);
  }
  CHECK(shapeLine(kNoFiles, "mine.WOFF2", "A").error().message.find("Nunito") == std::string::npos);
}

TEST_CASE("letters on a circle stand on it, above or below") {
  for (const double circle : {30.0, -30.0}) {
    CAPTURE(circle);
    const auto shape = textShape({"HHH", "Nunito", 6, circle}, kNoFiles);
    REQUIRE(shape.ok());
    const Vec2 middle = shape.value().page * 0.5;
    double nearest = 1e9, furthest = 0, left = 0, right = 0;
    for (const FilledPath& path : shape.value().paths) {
      for (const Ring& ring : path.rings) {
        for (const Vec2 point : ring) {
          const Vec2 from = point - middle;
          nearest = std::min(nearest, length(from));
          furthest = std::max(furthest, length(from));
          left = std::min(left, from.x);
          right = std::max(right, from.x);
          CHECK((from.y > 0) == (circle > 0));
        }
      }
    }
    // The page reaches as far as the ink, on all sides.
    const Bounds ink = bounds(shape.value());
    CHECK(std::max({ink.max.x, ink.max.y, 2 * middle.x - ink.min.x, 2 * middle.x - ink.min.y}) ==
          doctest::Approx(2 * middle.x));
    // The feet of a letter lie on a chord, its head a little beyond the circle.
    CHECK((circle > 0 ? nearest : furthest) == doctest::Approx(30).epsilon(0.02));
    CHECK((circle > 0 ? furthest : nearest) == doctest::Approx(circle > 0 ? 36 : 24).epsilon(0.04));
    CHECK(left == doctest::Approx(-right).epsilon(0.01));
  }
}

TEST_CASE("what cannot be lettered is refused in words") {
  const auto messageOf = [](const Lettering& lettering, const ReadInput& read = kNoFiles) {
    const auto shape = textShape(lettering, read);
    REQUIRE(!shape.ok());
    return shape.error().message;
  };
  CHECK(messageOf({"A\u5b57", "Nunito", 10}).find("(U+5B57)") != std::string::npos);
  CHECK(messageOf({"  ", "Nunito", 10}).find("no ink") != std::string::npos);
  CHECK(messageOf({std::string(60, 'M'), "Nunito", 10, 20}).find("126 mm") != std::string::npos);
  CHECK(messageOf({"MMMMMMM\nM", "Nunito", 10, 10}).find("longer") == std::string::npos);
  CHECK(messageOf({"A", "mine.ttf", 10}) == "no mine.ttf");
  const ReadInput text = [](const std::string&, const std::string&) {
    return Result<InputFile>(InputFile(std::string("no font")));
  };
  CHECK(messageOf({"A", "mine.ttf", 10}, text).find("is no font") != std::string::npos);
}

TEST_CASE("a font of one's own is read, and a damaged one does no harm") {
  const std::string whole = fontFile("fredoka");
  std::string given = whole;
  const ReadInput read = [&](const std::string&, const std::string& what) {
    CHECK(what == "font");
    return Result<InputFile>(InputFile(given));
  };
  const auto own = textShape({"Sillon", "own.ttf", 10}, read);
  const auto builtin = textShape({"Sillon", "Fredoka", 10}, kNoFiles);
  REQUIRE(own.ok());
  CHECK(own.value() == builtin.value());

  std::mt19937 random(5);
  int read_ = 0;
  for (int k = 0; k < 150; ++k) {
    given = whole;
    if (k % 3 == 0) given.resize(random() % whole.size());
    for (int n = 0; n < 1 + k % 40 && !given.empty(); ++n) given[random() % given.size()] = static_cast<char>(random());
    const auto shape = textShape({"Sillon", "own.ttf", 10}, read);
    if (!shape.ok()) continue;
    ++read_;
    CHECK(std::isfinite(shape.value().page.x));
  }
  CHECK(read_ > 10);
}

TEST_CASE("a text has a circle with a radius, and outlines within measure") {
  const auto flat = textShape({"A\nB", "Nunito", 10, 17}, kNoFiles);
  REQUIRE(!flat.ok());
  CHECK(flat.error().message.find("its circle 0 mm") != std::string::npos);
  const auto longest = textShape({std::string(60000, 'g'), "Caveat", 10}, kNoFiles);
  REQUIRE(!longest.ok());
  CHECK(longest.error().code == ErrorCode::TooLarge);
  CHECK(longest.error().message.find("more than 16 MiB of curves") != std::string::npos);
}

TEST_CASE("QR codes have their three finders and grow with the text") {
  const auto code = [](const std::string& text, QrCorrection correction) {
    return qrModules(text, correction, kNoFiles);
  };
  const Image small = code("SILLON", QrCorrection::Low).value();
  CHECK(small.width == 21);
  const auto dark = [&](int x, int y) { return small.at(x, y, 0) == 0; };
  for (const auto& [left, top] : {std::pair(0, 0), std::pair(14, 0), std::pair(0, 14)}) {
    for (int k = 0; k < 7; ++k) {
      CHECK(dark(left + k, top));
      CHECK(dark(left + k, top + 6));
      CHECK(dark(left, top + k));
    }
    CHECK(!dark(left + 1, top + 1));
    CHECK(dark(left + 3, top + 3));
  }
  CHECK(code(std::string(100, 'x'), QrCorrection::High).value().width >
        code(std::string(100, 'x'), QrCorrection::Low).value().width);
  const auto tooLong = code(std::string(3000, 'x'), QrCorrection::Medium);
  REQUIRE(!tooLong.ok());
  CHECK(tooLong.error().code == ErrorCode::TooLarge);
  CHECK(tooLong.error().message.find("3000 bytes") != std::string::npos);
}

TEST_CASE("text of a drawing is set in the font that it names, or in one that stands in for it") {
  const ShapeLetters letters{fontOfDrawing, [](const DrawingFont& font, const std::string& line) {
                               return shapeLineOfDrawing(kNoFiles, font, line);
                             }};
  const auto drawing = [&](const std::string& attributes, const std::string& text = "Sillon") {
    const auto shape =
        readSvg("<svg width='99mm' height='50mm' viewBox='0 0 99 50'><text x='5' y='30' font-size='10' " + attributes +
                    ">" + text + "</text></svg>",
                {.letters = letters});
    REQUIRE_MESSAGE(shape.ok(), (shape.ok() ? "" : shape.error().message));
    return shape.value();
  };
  const auto areaIn = [](const char* font) {
    const ShapedLine line = shapeLine(kNoFiles, font, "Sillon").value();
    return areaOf(textShape({"Sillon", font, 10 * line.capHeight / line.em}, kNoFiles).value());
  };
  const auto check = [&](const std::string& families, const char* font, bool instead) {
    CAPTURE(families);
    const Shape shape = drawing("font-family='" + families + "'");
    CHECK(areaOf(shape) == doctest::Approx(areaIn(font)).epsilon(1e-3));
    CHECK(shape.drawing.otherFont == instead);
  };
  check("Caveat", "Caveat", false);
  check("roboto slab, serif", "Roboto Slab", false);
  check("\"Bebas Neue\"", "Bebas Neue", false);
  check("Arial, Helvetica, sans-serif", "Nunito", true);
  check("Arial, Fredoka", "Fredoka", true);
  check("Georgia, serif", "Roboto Slab", true);
  check("Segoe Script", "Caveat", true);
  check("", "Nunito", false);
  CHECK(readSvg("<svg width='9' height='9'><rect width='9' height='9'/><text>\u5b57</text></svg>", {.letters = letters})
            .value()
            .drawing.texts == 0);
  CHECK(areaOf(drawing("", "Sil\u5b57lon")) == doctest::Approx(areaOf(drawing(""))).epsilon(1e-3));
}

TEST_CASE("a line tells the heights of its font") {
  const ShapedLine line = shapeLine(kNoFiles, "Nunito", "a").value();
  CHECK(line.em == 1000);
  CHECK(line.xHeight == 484);
  CHECK(line.ascent == 1011);
  CHECK(line.descent == 353);
}

TEST_CASE("lines of a drawing are named as shapeLine asks for them elsewhere") {
  CHECK(linesOfDrawing(
            "<svg width='9' height='9'><text font-family='Caveat'>a <tspan>b</tspan></text><text>c</text></svg>") ==
        std::vector<std::string>{"line:Caveat\na ", "line:Caveat\nb", "line:Nunito\nc"});
  CHECK(linesOfDrawing("no drawing").empty());
  const std::string many(60'000, 'a');
  CHECK(linesOfDrawing("<svg width='9' height='9'><text>" + many + "</text></svg>").size() == 1);
  CHECK(linesOfDrawing("<svg width='9' height='9'><text>a</text><text>" + many + "</text><text>b" + many +
                       "</text></svg>")
            .empty());
}

TEST_CASE("a code is read with as many wrong words in a block as half of its correction") {
  // The smallest code, with ten words of correction in one block; no more of it fits beside 20 letters.
  const Image inner = qrModules("SILLONSILLONSILLONSI", QrCorrection::Medium, kNoFiles).value();
  REQUIRE(inner.width == 21);
  const int side = inner.width + 2 * kQuietZone;
  const auto at = [&](int x, int y) { return static_cast<std::size_t>((y + kQuietZone) * side + x + kQuietZone); };
  Image code{side, side, 1, std::vector<std::uint16_t>(static_cast<std::size_t>(side * side), 65535)};
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 21; ++x) code.samples[at(x, y)] = inner.at(x, y, 0);
  }
  const std::vector<char> right(code.samples.size(), 0);
  CHECK(qrReads(code, right));
  const auto readsWithout = [&](const std::vector<std::pair<int, int>>& places) {
    std::vector<char> wrong = right;
    for (const auto& [x, y] : places) wrong[at(x, y)] = 1;
    return qrReads(code, wrong);
  };
  // Words of 2 x 4 modules, from the lower right corner up, then down again.
  std::vector<std::pair<int, int>> words{{20, 20}, {19, 13}, {20, 12}, {18, 9}, {17, 16}};
  CHECK(readsWithout(words));
  words.insert(words.end(), {{19, 20}, {20, 17}, {18, 12}, {17, 13}});  // in the same words
  CHECK(readsWithout(words));
  words.emplace_back(18, 18);
  CHECK_FALSE(readsWithout(words));

  // Three modules of both copies of the format may be wrong, and all of either copy.
  CHECK(readsWithout({{8, 0}, {8, 1}, {8, 2}, {8, 3}, {8, 20}, {8, 19}, {8, 18}}));
  CHECK_FALSE(readsWithout({{8, 0}, {8, 1}, {8, 2}, {8, 3}, {8, 20}, {8, 19}, {8, 18}, {20, 8}}));

  // The finder patterns are needed, and the light at the ends of the lines through their middles.
  for (const std::pair<int, int>& place : {std::pair{0, 0}, {20, 0}, {1, 19}, {17, 3}, {-1, 3}, {7, 4}, {16, -1}}) {
    CHECK_FALSE(readsWithout({place}));
  }
  CHECK(readsWithout({{-4, 3}, {10, -1}, {24, 24}}));
}
