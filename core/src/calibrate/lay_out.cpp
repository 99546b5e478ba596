#include "calibrate/prints.hpp"

#include <algorithm>
#include <cmath>

namespace sillon {
namespace {

constexpr double kOutline = 0.35;  // [mm] distance of the beads from the edge of their base

/// Lower left corner of cell `k`: four cells in a row, rows from the top down.
Vec2 cell(int k, Vec2 step) { return {(k % 4) * step.x, -(k / 4) * step.y}; }

/// Lays one disc per flow, with its value on a band below it.
void discs(PlateBuilder& plate) {
  constexpr double kRadius = 6.5;
  constexpr double kBackingRadius = kRadius + 0.5;
  constexpr double kNumbers = 5;  // [mm] height of the band below a disc
  constexpr double kTouch = 0.7;  // [mm] overlap of a band with its neighbours above and below
  plate.print().layers = 2;
  for (std::size_t k = 0; k < plate.values().size(); ++k) {
    const double value = plate.values()[k];
    const Vec2 corner = cell(static_cast<int>(k), {2 * kBackingRadius, 2 * kBackingRadius + kNumbers - kTouch});
    const Vec2 centre = corner + Vec2{kBackingRadius, kNumbers + kBackingRadius};
    plate.base(disc(centre, kBackingRadius));
    plate.base(box(corner, corner + Vec2{2 * kBackingRadius, kNumbers + kTouch}));
    plate.labelAt(written(value, 2), corner + Vec2{kBackingRadius, (kTouch + kNumbers) / 2});
    plate.value(value, written(value, 2), centre);
    for (const int layer : {1, 2})
      plate.patch({spiral(centre, kRadius, plate.width(), plate.width())}, layer).flow = value;
  }
}

/// Lays one row per value, one below the other, each with its value on the left.
/// \param length, high  size of a row, with its distance to the next [mm].
/// \param lay  lays a row: (its lower left corner, value).
template <class Lay>
void rows(PlateBuilder& plate, double length, double high, const Lay& lay) {
  const int digits = plate.digits();
  double writing = 0;
  for (const double value : plate.values()) writing = std::max(writing, kUnit * textWidth(written(value, digits)));
  const double left = writing + 2 * kMargin + plate.width();
  const auto count = static_cast<double>(plate.values().size());
  plate.base(box({-left, -count * high}, {length + kOutline, kOutline}));
  for (std::size_t k = 0; k < plate.values().size(); ++k) {
    const double value = plate.values()[k];
    const Vec2 corner{0, -high * static_cast<double>(k + 1) + kOutline};
    const std::string label = written(value, digits);
    plate.label(label, corner + Vec2{-left + kMargin + plate.width() / 2, (high - kOutline - kHigh) / 2});
    plate.value(value, label, corner + 0.5 * Vec2{length, high - kOutline});
    lay(corner, value);
  }
}

/// Lays one row per speed; the right half of each has constant flow.
void speeds(PlateBuilder& plate) {
  plate.labels().speed = plate.values().front();
  const double width = plate.width();
  const double half = 18 + width;  // two waves of 9 mm, and a bead
  const int lines = 2 * std::max(1, static_cast<int>(2 / width));
  rows(plate, 2 * half + 2, std::max(lines * width + 0.6, kHigh + 1.2), [&](Vec2 corner, double value) {
    for (const bool constant : {false, true}) {
      const Vec2 from = corner + Vec2{constant ? half + 2 : 0, 0};
      Patch& patch = plate.patch({wavyRow(from, half, lines, width)});
      patch.speed = value;
      patch.constantFlow = constant;
      patch.spacing = width;
    }
  });
}

/// Lays one strip per fan speed.
void fans(PlateBuilder& plate) {
  constexpr double kLength = 36;
  const double high = std::max(1.0, std::floor(4.6 / plate.width())) * plate.width();
  rows(plate, kLength, high + 0.6, [&](Vec2 corner, double value) {
    plate.patch(filled(box(corner, corner + Vec2{kLength, high}), {1, 0}, plate.width())).fan = value;
  });
}

/// Lays a wedge with its narrow end on the left, and ticks and numbers below it.
void wedgeWithTicks(PlateBuilder& plate, Vec2 leftMiddle, double length, int lines) {
  const double nozzle = plate.width();
  const double least = plate.values().front();
  const double most = plate.values().back();
  plate.patch({wedge(leftMiddle, length, lines, least, most)});
  const double bottom = leftMiddle.y - lines * most / 2;
  for (const double value : plate.values()) {
    const double x = std::clamp(leftMiddle.x + length * (value - least) / (most - least), leftMiddle.x + nozzle / 2,
                                leftMiddle.x + length - nozzle / 2);
    plate.draw({stroke({x, bottom - 1 - 1.2}, {x, bottom - 1}, nozzle)});
    plate.labelAt(written(value, 2), {x, bottom - 2.8 - kHigh / 2});
  }
}

/// Lays a wedge whose beads grow from the first width to the last.
void widths(PlateBuilder& plate) {
  constexpr double kLength = 55;
  constexpr int kLines = 12;
  const double most = plate.values().back();
  const double side = kUnit * textWidth(".00") / 2 + kMargin + plate.width();
  const double top = kLines * most / 2 + kOutline;
  plate.base(box({-side, -top - 3 - kHigh - kMargin}, {kLength + side, top}));
  const double least = plate.values().front();
  for (const double value : plate.values()) {
    plate.value(value, written(value, 2), {kLength * (value - least) / (most - least), 0});
  }
  wedgeWithTicks(plate, {0, 0}, kLength, kLines);
}
/// Lays the star of directions within a dial of 24 ticks.
void directions(PlateBuilder& plate) {
  constexpr double kInner = 5;
  constexpr double kOuter = 19;
  constexpr double kTick = 1.4;
  constexpr double kNumbers = 25.2;
  constexpr double kSmall = 0.45;  // [mm] unit of small writing: capitals of 2.7 mm
  plate.base(disc({0, 0}, 29.2));
  for (int k = 0; k < 24; ++k) {
    const double length = k % 3 == 0 ? kTick : kTick / 2;
    plate.draw({stroke((kOuter + 0.8) * spoke(k), (kOuter + 0.8 + length) * spoke(k), plate.width())});
    if (k % 3 == 0) plate.labelAt(std::to_string(15 * k), kNumbers * spoke(k), kSmall);
  }
  layStar(plate, {0, 0}, kInner, kOuter, true);
}

}  // namespace

void layOut(CalibrationKind kind, PlateBuilder& plate) {
  constexpr void (*kLays[])(PlateBuilder&) = {discs, speeds, fans, widths, directions, nullptr, layCoupon};
  if (kind != CalibrationKind::Swatch) kLays[static_cast<std::size_t>(kind)](plate);
}

}  // namespace sillon
