#include "input/svg/svg_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "geometry/outline.hpp"
#include "input/svg/svg_reader.hpp"

namespace sillon::svg {
namespace {

Vec2 vectorBy(const Matrix& m, Vec2 v) {
  const Eigen::Vector2d out = m.linear() * Eigen::Vector2d(v.x, v.y);
  return {out.x(), out.y()};
}
Vec2 pointBy(const Matrix& m, Vec2 p) { return vectorBy(m, p) + Vec2{m.translation().x(), m.translation().y()}; }

// Tells whether the points span more than a line of 1 nm.
bool hasArea(const Ring& ring) {
  if (ring.size() < 3) return false;
  Vec2 longest;
  for (const Vec2 p : ring) {
    if (length(p - ring[0]) > length(longest)) longest = p - ring[0];
  }
  const double room = 1e-6 * length(longest);
  return std::any_of(ring.begin(), ring.end(),
                     [&](Vec2 p) { return std::abs(cross(longest, p - ring[0])) >= 0.999 * room; });
}

// Draws an arc; converts end points to a centre as in sec. B.2.4 of SVG 2.
void arcTo(Outliner& out, Vec2 from, Vec2 radii, double degrees, bool large, bool clockwise, Vec2 to) {
  if (from == to) return;
  double rx = std::abs(radii.x), ry = std::abs(radii.y);
  if (rx == 0 || ry == 0) return out.line(from, to);
  const Matrix turn = rotation(degrees);
  const Matrix back = rotation(-degrees);
  // h is half the chord, in the frame in which the ellipse is the unit circle; dot(h, h) tells the centre's distance.
  Vec2 h = vectorBy(back, 0.5 * (from - to));
  h = {h.x / rx, h.y / ry};
  const double half = dot(h, h);
  if (!(half < 1e100)) refuse("SvgArcRadii");
  if (half < 1e-14 && !large) return out.line(from, to);  // the arc leaves the chord by less than 1e-7 of its length
  if (half > 1) {                                         // the radii do not reach the end and grow until they do
    rx *= std::sqrt(half);
    ry *= std::sqrt(half);
    h = h * (1 / std::sqrt(half));
  }
  const double distance = std::sqrt(std::max(0.0, 1 / std::min(half, 1.0) - 1)) * (large == clockwise ? -1 : 1);
  const Vec2 center{h.y * distance, -h.x * distance};  // in units of the radii, from the chord's middle
  const Vec2 first = h - center, last = -h - center;
  double sweep = std::atan2(cross(first, last), dot(first, last));
  if (clockwise && sweep < 0) sweep += 2 * std::numbers::pi;
  if (!clockwise && sweep > 0) sweep -= 2 * std::numbers::pi;
  const Vec2 u = vectorBy(turn, {rx, 0}), v = vectorBy(turn, {0, ry});
  out.arc(from, 0.5 * (from + to) + center.x * u + center.y * v, u, v, std::atan2(first.y, first.x), sweep, to);
}

}  // namespace

void refusePoints() { refuseTooLarge("SvgPoints", {{"most", kMaxPoints}}); }

Vec2 onGrid(Vec2 p) {
  if (!(std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate)) {
    refuse("SvgPointTooFar");
  }
  // Adding 0 turns -0 into 0.
  return {std::round(p.x * 1e6) / 1e6 + 0.0, std::round(p.y * 1e6) / 1e6 + 0.0};
}

Matrix rotation(double degrees) { return Matrix(Eigen::Rotation2Dd(degrees / 180 * std::numbers::pi)); }

void Outliner::line(Vec2 from, Vec2 to) {
  begin(from);
  add(pointBy(toWorld_, to));
}

void Outliner::quadratic(Vec2 from, Vec2 control, Vec2 to) {
  begin(from);
  const Vec2 a = pointBy(toWorld_, from), b = pointBy(toWorld_, control), c = pointBy(toWorld_, to);
  const int n = pieces(2 * length(a - 2.0 * b + c));
  for (int i = 1; i < n; ++i) {
    const double t = static_cast<double>(i) / n, s = 1 - t;
    add(s * s * a + 2 * s * t * b + t * t * c, true);
  }
  add(c);
}

void Outliner::cubic(Vec2 from, Vec2 control1, Vec2 control2, Vec2 to) {
  begin(from);
  const Vec2 a = pointBy(toWorld_, from), b = pointBy(toWorld_, control1);
  const Vec2 c = pointBy(toWorld_, control2), d = pointBy(toWorld_, to);
  const int n = pieces(6 * std::max(length(a - 2.0 * b + c), length(b - 2.0 * c + d)));
  for (int i = 1; i < n; ++i) {
    const double t = static_cast<double>(i) / n, s = 1 - t;
    add(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d, true);
  }
  add(d);
}

void Outliner::arc(Vec2 from, Vec2 center, Vec2 u, Vec2 v, double angle, double sweep, Vec2 to) {
  begin(from);
  const Vec2 c = pointBy(toWorld_, center), p = vectorBy(toWorld_, u), q = vectorBy(toWorld_, v);
  // The second derivative stays below the longest half axis of the transformed ellipse.
  const double pp = dot(p, p), qq = dot(q, q), pq = dot(p, q);
  const double axis = std::sqrt((pp + qq + std::sqrt((pp - qq) * (pp - qq) + 4 * pq * pq)) / 2);
  const int n =
      std::max(pieces(axis * sweep * sweep), static_cast<int>(std::ceil(std::abs(sweep) / (std::numbers::pi / 4))));
  for (int i = 1; i < n; ++i) {
    const double at = angle + sweep * i / n;
    add(c + std::cos(at) * p + std::sin(at) * q, true);
  }
  add(pointBy(toWorld_, to));
}

void Outliner::quarter(Vec2 center, Vec2 u, Vec2 v) {
  arc(center + u, center, u, v, 0, std::numbers::pi / 2, center + v);
}

void Outliner::begin(Vec2 from) {
  if (line_.points.empty()) add(pointBy(toWorld_, from));
}

void Outliner::end() {
  if (!line_.points.empty()) lines_.push_back(std::move(line_));
  line_ = {};
}

void Outliner::close() {
  line_.closed = true;
  end();
}

std::vector<Ring> Outliner::rings(std::vector<LoosePiece>* loose) const {
  std::vector<Ring> rings;
  for (const PathLine& line : lines_) {
    Ring ring = line.points;
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    const bool area = hasArea(ring);
    const bool open = !line.closed && ring.size() == line.points.size() && ring.size() > 1;
    if (loose != nullptr && open) loose->push_back({ring, 0, area ? rings.size() : kNoRing});
    if (area) rings.push_back(std::move(ring));
  }
  return rings;
}

// Returns the number of chords for a curve over t in [0, 1] whose second derivative stays below `bend`: a piece of 1/n
// leaves its chord by at most bend / (8 n²).
int Outliner::pieces(double bend) const {
  const double n = std::ceil(std::sqrt(bend / (8 * tolerance_)));
  if (!(n <= static_cast<double>(pointsLeft_))) refusePoints();
  return std::max(1, static_cast<int>(n));
}

void Outliner::add(Vec2 p, bool smooth) {
  p = onGrid(p);
  if (!line_.points.empty() && line_.points.back() == p) {
    if (!smooth) line_.smooth.back() = 0;
    return;
  }
  if (--pointsLeft_ < 0) refusePoints();
  line_.points.push_back(p);
  line_.smooth.push_back(smooth ? 1 : 0);
}

void drawPath(Outliner& out, std::string_view text) {
  if (trimmed(text) == "none") return;
  Reader reader(text, "d");
  Vec2 at, start, control;  // control: last control point of a curve, for the smooth commands
  char command = '\0', previous = '\0';
  while (!reader.atEnd()) {
    previous = command;
    if (isLetter(reader.peek())) {
      if (std::string_view("MmLlHhVvCcSsQqTtAaZz").find(reader.peek()) == std::string_view::npos) {
        reader.fail("SvgCommand");
      }
      command = reader.take();
    } else if (command == 'M' || command == 'm') {
      command = command == 'M' ? 'L' : 'l';
    } else if (command == 'Z' || command == 'z') {
      reader.fail("SvgCommand");
    }
    if (previous == '\0' && lower(command) != 'm') reader.fail("SvgFirstCommand");

    const char kind = lower(command);
    const Vec2 origin = kind == command ? at : Vec2{};
    const auto point = [&] {
      const double x = reader.number();
      return origin + Vec2{x, reader.number()};
    };
    const char before = lower(previous);
    switch (kind) {
      case 'm':
        out.end();
        start = at = point();
        break;
      case 'z':
        out.begin(at);
        out.close();
        at = start;
        break;
      case 'h':
      case 'v':
      case 'l': {
        Vec2 to = at;
        if (kind == 'h') to.x = origin.x + reader.number();
        if (kind == 'v') to.y = origin.y + reader.number();
        if (kind == 'l') to = point();
        out.line(at, to);
        at = to;
        break;
      }
      case 'c':
      case 's': {
        const bool smooth = before == 'c' || before == 's';
        const Vec2 first = kind == 'c' ? point() : (smooth ? 2.0 * at - control : at);
        control = point();
        const Vec2 to = point();
        out.cubic(at, first, control, to);
        at = to;
        break;
      }
      case 'q':
      case 't': {
        const bool smooth = before == 'q' || before == 't';
        control = kind == 'q' ? point() : (smooth ? 2.0 * at - control : at);
        const Vec2 to = point();
        out.quadratic(at, control, to);
        at = to;
        break;
      }
      default: {  // 'a'
        const double rx = reader.number();
        const double ry = reader.number();
        const double degrees = reader.number();
        const bool large = reader.flag();
        const bool clockwise = reader.flag();
        const Vec2 to = point();
        arcTo(out, at, {rx, ry}, degrees, large, clockwise, to);
        at = to;
      }
    }
  }
  out.end();
}

void drawPolygon(Outliner& out, std::string_view text, bool closed) {
  Reader reader(text, "points");
  std::optional<Vec2> previous;
  while (!reader.atEnd()) {
    const double x = reader.number();
    const Vec2 p{x, reader.number()};
    if (previous) out.line(*previous, p);
    previous = p;
  }
  closed ? out.close() : out.end();
}

void drawEllipse(Outliner& out, Vec2 center, Vec2 radii) {
  const Vec2 u{radii.x, 0}, v{0, radii.y};
  out.quarter(center, u, v);
  out.quarter(center, v, -u);
  out.quarter(center, -u, -v);
  out.quarter(center, -v, u);
  out.close();
}

void drawRectangle(Outliner& out, Vec2 corner, Vec2 size, Vec2 radii) {
  const Vec2 r{std::min(radii.x, size.x / 2), std::min(radii.y, size.y / 2)};
  const Vec2 end = corner + size;
  if (!(r.x > 0 && r.y > 0)) {
    out.line(corner, {end.x, corner.y});
    out.line({end.x, corner.y}, end);
    out.line(end, {corner.x, end.y});
    return out.close();
  }
  const Vec2 u{r.x, 0}, v{0, r.y};
  out.quarter({end.x - r.x, corner.y + r.y}, -v, u);
  // The straight sides connect the ends of the quarters.
  const auto corneredAt = [&](Vec2 center, Vec2 first, Vec2 second, Vec2 from) {
    out.line(from, center + first);
    out.quarter(center, first, second);
  };
  corneredAt({end.x - r.x, end.y - r.y}, u, v, {end.x, corner.y + r.y});
  corneredAt({corner.x + r.x, end.y - r.y}, v, -u, {end.x - r.x, end.y});
  corneredAt({corner.x + r.x, corner.y + r.y}, -u, -v, {corner.x, end.y - r.y});
  out.close();
}

}  // namespace sillon::svg
