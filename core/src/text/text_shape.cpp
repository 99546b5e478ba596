// Lays out shaped lines, straight or on a circle. It writes the letters as an SVG and reads that back, because the SVG
// reader flattens curves and guards against hostile fonts.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/exact_math.hpp"
#include "base/json.hpp"
#include "base/lines.hpp"
#include "base/refused.hpp"
#include "geometry/shape_points.hpp"
#include "input/shaped_line.hpp"
#include "input/svg.hpp"
#include "sillon/base/words.hpp"
#include "sillon/text/text.hpp"
#include "text/letters.hpp"

namespace sillon {
namespace {

constexpr double kLineStep = 1.7;  // distance from line to line [heights of capitals]
constexpr double kRoom = 4;        // room for ink around a line [heights of capitals]; accents and swashes fit into it
// Largest share of a circle that a line may take: it may fill the circle, but must not overlap itself.
constexpr double kLargestShare = 1.0;

double widthOf(const ShapedLine& line) {
  double width = 0;
  for (const ShapedLine::Letter& letter : line.letters) width += letter.advance;
  return width;
}

/// Returns a letter's outline as a path, mapped from font units to the page: scaled, turned, moved.
std::string placed(const std::string& outline, double scale, exact::SinCos turn, Vec2 at) {
  std::string out = "<path d=\"" + outline + "\" transform=\"matrix(";
  for (const double number : {scale * turn.cos, scale * turn.sin, -scale * turn.sin, scale * turn.cos, at.x}) {
    (out += jsonNumber(number)) += ' ';
  }
  return out += jsonNumber(at.y) + ")\"/>";
}

/// A drawing of letters around the origin, y up.
struct LetterDrawing {
  std::string paths;
  double reach = 0;  ///< bound on the distance of ink from the origin [mm]
};

/// Sets lines below each other, aligned to a side or to the middle.
LetterDrawing straight(const std::vector<ShapedLine>& lines, const Lettering& lettering) {
  LetterDrawing drawing;
  double widest = 0;
  for (const ShapedLine& line : lines) {
    if (line.capHeight > 0) widest = std::max(widest, widthOf(line) / line.capHeight * lettering.capHeight);
  }
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const ShapedLine& line = lines[k];
    const double scale = lettering.capHeight / line.capHeight;
    const double free = widest - widthOf(line) * scale;
    const double share = lettering.align == TextAlign::Left ? 0 : lettering.align == TextAlign::Middle ? 0.5 : 1;
    Vec2 pen{share * free - widest / 2, -kLineStep * lettering.capHeight * static_cast<double>(k)};
    for (const ShapedLine::Letter& letter : line.letters) {
      drawing.paths += placed(line.outlines[letter.outline], scale, {0, 1}, pen + letter.offset * scale);
      pen.x += letter.advance * scale;
    }
  }
  drawing.reach = widest / 2 + lettering.capHeight * (kRoom + kLineStep * static_cast<double>(lines.size()));
  return drawing;
}

/// Sets lines on circles around the origin, each centred at the top or at the bottom.
Result<LetterDrawing> onCircle(const std::vector<ShapedLine>& lines, const Lettering& lettering) {
  LetterDrawing drawing;
  const bool below = lettering.circle < 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const ShapedLine& line = lines[k];
    const double scale = lettering.capHeight / line.capHeight;
    const double step = kLineStep * lettering.capHeight * static_cast<double>(k);
    const double radius = std::abs(lettering.circle) + (below ? step : -step);
    const double width = widthOf(line) * scale;
    if (!(radius > 0 && width <= kLargestShare * 2 * std::numbers::pi * radius)) {
      return refusedArgument(
          "LineLongerThanCircle",
          {{"line", std::lround(width)}, {"circle", std::lround(std::max(0.0, 2 * std::numbers::pi * radius))}});
    }
    // Each letter is turned so that its own middle stands upright on the circle. Letters run clockwise at the top and
    // counter-clockwise at the bottom.
    double pen = -width / 2;
    for (const ShapedLine::Letter& letter : line.letters) {
      const double half = letter.advance * scale / 2;
      const double angle = (pen + half) / radius;
      const exact::SinCos turn = exact::sinCos(below ? angle : -angle);
      const double height = below ? -radius : radius;
      const Vec2 corner = Vec2{-half, height} + letter.offset * scale;
      const Vec2 at{turn.cos * corner.x - turn.sin * corner.y, turn.sin * corner.x + turn.cos * corner.y};
      drawing.paths += placed(line.outlines[letter.outline], scale, turn, at);
      pen += 2 * half;
    }
    drawing.reach = std::max(drawing.reach, radius + kRoom * lettering.capHeight);
  }
  return drawing;
}

/// Reads the letters as a square SVG with the drawing's origin in its middle.
Result<Shape> shapeOf(const LetterDrawing& drawing) {
  const std::string reach = jsonNumber(drawing.reach), side = jsonNumber(2 * drawing.reach);
  const Result<Shape> read =
      readSvg("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + side + "mm\" height=\"" + side +
              "mm\" viewBox=\"0 0 " + side + " " + side + "\"><g transform=\"matrix(1 0 0 -1 " + reach + " " + reach +
              ")\">" + drawing.paths + "</g></svg>");
  if (!read && read.error().code == ErrorCode::EmptyShape) {
    return refused(ErrorCode::EmptyShape, "TextWithoutInk");
  }
  return read;
}

/// Moves all points so that `corner` becomes the page's lower left corner.
Shape moved(Shape shape, Vec2 corner, Vec2 page) {
  movePoints(shape, [&](Vec2 point) { return point - corner; });
  shape.page = page;
  return shape;
}

/// Lays the lines out on the page that textShape() returns.
Result<Shape> laidOut(const std::vector<ShapedLine>& lines, const Lettering& lettering) {
  if (lettering.circle == 0) {
    Result<Shape> shape = shapeOf(straight(lines, lettering));
    if (!shape) return shape.error();
    const Bounds ink = bounds(shape.value());
    return moved(std::move(shape).value(), ink.min, ink.size());
  }
  const Result<LetterDrawing> drawing = onCircle(lines, lettering);
  if (!drawing) return drawing.error();
  Result<Shape> shape = shapeOf(drawing.value());
  if (!shape) return shape;
  // The page extends as far from the circle's middle as the ink does.
  const double middle = shape.value().page.x / 2;
  const Bounds ink = bounds(shape.value());
  const double reach = std::max({ink.max.x - middle, middle - ink.min.x, ink.max.y - middle, middle - ink.min.y});
  return moved(std::move(shape).value(), {middle - reach, middle - reach}, {2 * reach, 2 * reach});
}

}  // namespace

Result<Shape> textShape(const Lettering& lettering, const ReadInput& read) {
  std::vector<ShapedLine> lines;
  std::vector<LackedLetter> lacked;
  std::size_t bytes = 0;
  std::string_view rest = lettering.text;
  while (!rest.empty()) {
    const std::string line(nextLine(rest));
    Result<ShapedLine> shaped = shapeLine(read, lettering.font, line, lettering.weight);
    if (!shaped) return shaped.error();
    lines.push_back(std::move(shaped).value());
    const ShapedLine& known = lines.back();
    for (const LackedLetter& letter : known.lacked) {
      if (letter.font.empty()) return missingLetter(lettering.font, letter);
      addLacked(lacked, letter);
    }
    for (const ShapedLine::Letter& letter : known.letters) bytes += known.outlines[letter.outline].size();
    if (bytes > kMostDrawnBytes) return tooDetailed(lettering.font, kMostDrawnBytes);
  }
  Result<Shape> shape = laidOut(lines, lettering);
  if (shape) shape.value().drawing.lacked = std::move(lacked);
  return shape;
}

}  // namespace sillon
