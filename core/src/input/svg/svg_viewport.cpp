#include "input/svg/svg_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace sillon::svg {

Matrix matrix(double a, double b, double c, double d, double e, double f) {
  Matrix m = Matrix::Identity();
  m.linear() << a, c, b, d;
  m.translation() << e, f;
  return m;
}

Matrix shifted(double x, double y) { return Matrix(Eigen::Translation2d(x, y)); }

namespace {

// Converts a number with its unit: angles to degrees, lengths to user units; a plain number stays.
double withUnit(Reader& reader, double value, double full, const UserUnits& units) {
  if (reader.peek() == '%') {
    reader.take();
    return value / 100 * full;
  }
  const std::string unit = lowered(reader.word());
  if (unit.empty() || unit == "deg") return value;
  if (unit == "rad") return value * 180 / std::numbers::pi;
  if (unit == "turn") return value * 360;
  if (unit == "grad") return value * 0.9;
  const std::optional<Unit> known = unitOf(unit);
  if (!known) reader.fail("SvgUnitHere");
  return units.of(value, *known);
}

double tangent(double degrees) { return std::tan(degrees / 180 * std::numbers::pi); }

}  // namespace

Matrix parseTransform(std::string_view text, const CssLengths* css) {
  Reader reader(text, "transform");
  Matrix result = Matrix::Identity();
  if (trimmed(text) == "none") return result;
  while (!reader.atEnd()) {
    reader.skipSeparator();
    const std::string_view name = reader.word();
    if (name.empty()) reader.fail("SvgTransform");
    reader.expect('(');
    std::array<double, 6> v{};
    std::size_t n = 0;
    for (reader.skipSpace(); reader.peek() != ')'; reader.skipSpace()) {
      if (n == v.size()) reader.expect(')');
      v[n] = reader.number();
      if (css) {
        const bool ofHeight = n == 1 || name == "translateY";
        const double full = startsWith(name, "scale") ? 1 : ofHeight ? css->box.y : css->box.x;
        v[n] = withUnit(reader, v[n], full, css->units);
      }
      ++n;
    }
    reader.expect(')');
    if (name == "matrix" && n == 6) {
      result = result * matrix(v[0], v[1], v[2], v[3], v[4], v[5]);
    } else if (name == "translate" && (n == 1 || n == 2)) {
      result = result * shifted(v[0], v[1]);
    } else if (name == "scale" && (n == 1 || n == 2)) {
      result = result * matrix(v[0], 0, 0, n == 1 ? v[0] : v[1], 0, 0);
    } else if (name == "rotate" && (n == 1 || (n == 3 && !css))) {
      result = result * shifted(v[1], v[2]) * rotation(v[0]) * shifted(-v[1], -v[2]);
    } else if (name == "skewX" && n == 1) {
      result = result * matrix(1, 0, tangent(v[0]), 1, 0, 0);
    } else if (name == "skewY" && n == 1) {
      result = result * matrix(1, tangent(v[0]), 0, 1, 0, 0);
    } else if (css && name == "skew" && (n == 1 || n == 2)) {
      result = result * matrix(1, tangent(v[1]), tangent(v[0]), 1, 0, 0);
    } else if (css && name == "translateX" && n == 1) {
      result = result * shifted(v[0], 0);
    } else if (css && name == "translateY" && n == 1) {
      result = result * shifted(0, v[0]);
    } else if (css && name == "scaleX" && n == 1) {
      result = result * matrix(v[0], 0, 0, 1, 0, 0);
    } else if (css && name == "scaleY" && n == 1) {
      result = result * matrix(1, 0, 0, v[0], 0, 0);
    } else {
      refuse("SvgTransformNumbers", {{"text", quoted(name)}, {"count", n}});
    }
  }
  return result;
}

Vec2 parseOrigin(std::string_view text, const CssLengths& css) {
  Vec2 origin = css.box * 0.5;  // the default is the centre
  bool second = false;
  split(text, ' ', [&](std::string_view word) {
    const std::string part = lowered(trimmed(word));
    if (part.empty()) return;
    double& axis = second ? origin.y : origin.x;
    const double length = css.units.ofStyle(part, second ? css.box.y : css.box.x);
    if (part == "left" || part == "right") {
      origin.x = part == "left" ? 0 : css.box.x;
    } else if (part == "top" || part == "bottom") {
      origin.y = part == "top" ? 0 : css.box.y;
    } else if (std::isfinite(length)) {
      axis = length;
    } else if (part != "center") {
      refuse("SvgTransformOrigin", {{"text", quoted(text)}});
    }
    second = true;
  });
  return origin;
}

std::optional<ViewBox> viewBoxOf(const Node& node) {
  const auto text = attribute(node, "viewBox");
  if (!text || trimmed(*text) == "none") return std::nullopt;
  Reader reader(*text, "viewBox");
  ViewBox box;
  box.min.x = reader.number();
  box.min.y = reader.number();
  box.size.x = reader.number();
  box.size.y = reader.number();
  if (!reader.atEnd()) reader.fail("SvgEnd");
  if (!(box.size.x > 0 && box.size.y > 0)) {
    refuse("SvgViewBox", {{"text", quoted(*text)}});
  }
  return box;
}

Matrix fit(const Node& node, const ViewBox& box, Vec2 size) {
  const std::string_view text = attribute(node, "preserveAspectRatio").value_or("");
  Reader reader(text, "preserveAspectRatio");
  reader.skipSpace();
  std::string_view align = reader.word();
  if (align == "defer") {
    reader.skipSpace();
    align = reader.word();
  }
  reader.skipSpace();
  const std::string_view mode = reader.word();
  const auto unknown = [&] { refuse("SvgAspectRatio", {{"text", quoted(text)}}); };
  if (!reader.atEnd() || !(mode.empty() || mode == "meet" || mode == "slice")) unknown();

  Vec2 scale{size.x / box.size.x, size.y / box.size.y};
  if (align == "none") return matrix(scale.x, 0, 0, scale.y, -box.min.x * scale.x, -box.min.y * scale.y);

  if (align.empty()) align = "xMidYMid";
  const auto share = [&](std::string_view part) {  // share of the free room that lies before the box
    if (part == "Min") return 0.0;
    if (part == "Mid") return 0.5;
    if (part != "Max") unknown();
    return 1.0;
  };
  if (align.size() != 8 || align[0] != 'x' || align[4] != 'Y') unknown();
  const Vec2 before{share(align.substr(1, 3)), share(align.substr(5, 3))};
  const double s = mode == "slice" ? std::max(scale.x, scale.y) : std::min(scale.x, scale.y);
  return matrix(s, 0, 0, s, before.x * (size.x - box.size.x * s) - box.min.x * s,
                before.y * (size.y - box.size.y * s) - box.min.y * s);
}

}  // namespace sillon::svg
