#include "calibrate/prints.hpp"

#include <algorithm>
#include <cmath>

#include "base/fast_math.hpp"

namespace sillon {
namespace {

constexpr double kWave = 9;         // [mm] length of a wave of a wavy row's widths
constexpr double kSwing = 0.25;     // [width] amplitude of that wave
constexpr double kRounding = 1e-6;  // [mm] slack for rounding errors

Vec2 onCircle(double radians) {
  const SinCos turn = sinCos(static_cast<float>(radians));
  return {static_cast<double>(turn.cos), static_cast<double>(turn.sin)};
}

// Finds the part of a line, at `v` along `across`, that lies at least `inset` within a convex polygon.
// \param[out] begin, end  its ends, measured along `along`. \return false if there is no such part.
bool chord(const Ring& polygon, Vec2 along, Vec2 across, double v, double inset, double& begin, double& end) {
  begin = -1e9;
  end = 1e9;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k];
    const Vec2 side = polygon[(k + 1) % polygon.size()] - a;
    const double size = length(side);
    if (!(size > 0)) continue;
    const Vec2 inward = (1 / size) * Vec2{-side.y, side.x};
    const double slope = dot(inward, along);
    const double rest = dot(inward, a) + inset - v * dot(inward, across);  // slope * u >= rest
    if (std::abs(slope) < kRounding) {
      if (rest > kRounding) return false;
    } else if (slope > 0) {
      begin = std::max(begin, rest / slope);
    } else {
      end = std::min(end, rest / slope);
    }
  }
  return begin < end;
}

}  // namespace

Ring box(Vec2 low, Vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

Ring disc(Vec2 centre, double radius) {
  constexpr int kCorners = 96;
  Ring ring;
  for (int k = 0; k < kCorners; ++k) {
    ring.push_back(centre + radius * onCircle(2 * static_cast<double>(kPi) * k / kCorners));
  }
  return ring;
}

std::vector<PatchLine> filled(const Ring& polygon, Vec2 along, double width) {
  const Vec2 across{-along.y, along.x};
  double low = 1e9;
  double high = -1e9;
  for (const Vec2 p : polygon) {
    low = std::min(low, dot(p, across));
    high = std::max(high, dot(p, across));
  }
  const int rows = static_cast<int>((high - low) / width + kRounding);
  const double first = (low + high - (rows - 1) * width) / 2;
  PatchLine line;
  for (int row = 0; row < rows; ++row) {
    const double v = first + row * width;
    double begin = 0;
    double end = 0;
    if (!chord(polygon, along, across, v, width / 2 - kRounding, begin, end)) continue;
    if (line.points.size() % 4 == 2) std::swap(begin, end);
    line.points.push_back(begin * along + v * across);
    line.points.push_back(end * along + v * across);
  }
  if (line.points.empty()) return {};
  line.widths.assign(line.points.size(), width);
  return {line};
}

PatchLine spiral(Vec2 centre, double radius, double width, double pitch) {
  constexpr int kSteps = kSpiralSteps;
  PatchLine line;
  // The bead's cell in each round is a ring; all rings together have the disc's area.
  const double turns = radius / pitch;
  const int last = static_cast<int>(std::ceil(turns * kSteps));
  for (int k = kSteps / 4; k <= last; ++k) {
    const double turn = std::min(static_cast<double>(k) / kSteps, turns);
    const double angle = 2 * static_cast<double>(kPi) * (turn - std::floor(turn));
    line.points.push_back(centre + turn * pitch * onCircle(angle));
  }
  line.widths.assign(line.points.size(), width);
  return line;
}

PatchLine wedge(Vec2 leftMiddle, double length, int lines, double from, double to) {
  PatchLine line;
  const double inset = from / 2;
  const double outset = length - to / 2;
  for (int k = 0; k < lines; ++k) {
    const double place = k - (lines - 1) / 2.0;
    const auto at = [&](double x) {
      const double width = from + (to - from) * x / length;
      line.points.push_back(leftMiddle + Vec2{x, place * width});
      line.widths.push_back(width);
    };
    at(k % 2 == 0 ? inset : outset);
    at(k % 2 == 0 ? outset : inset);
  }
  return line;
}

PatchLine wavyRow(Vec2 corner, double length, int lines, double width) {
  PatchLine line;
  const double run = length - width;
  const int knots = static_cast<int>(std::lround(run / (kWave / 4)));
  for (int k = 0; k < lines; ++k) {
    const bool upper = k % 2 == 1;
    for (int j = 0; j <= knots; ++j) {
      const int i = upper ? knots - j : j;
      constexpr double kTriangle[] = {0, 1, 0, -1};
      const double swing = kSwing * kTriangle[i % 4];
      const double own = width * (upper ? 1 - swing : 1 + swing);
      const double bottom = (k - (upper ? 1 : 0)) * width;  // lower edge of the pair of beads
      const double middle = upper ? bottom + 2 * width - own / 2 : bottom + own / 2;
      line.points.push_back(corner + Vec2{width / 2 + run * i / knots, middle});
      line.widths.push_back(own);
    }
  }
  return line;
}

std::vector<PatchLine> writing(std::string_view text, Vec2 corner, double unit, double width) {
  std::vector<PatchLine> lines;
  for (std::vector<Vec2>& points : textStrokes(text, corner, unit)) {
    std::vector<double> widths(points.size(), width);
    lines.push_back({std::move(points), std::move(widths)});
  }
  return lines;
}

PatchLine stroke(Vec2 from, Vec2 to, double width) { return {{from, to}, {width, width}}; }

}  // namespace sillon
