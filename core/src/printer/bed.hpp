// The bed on which a job must stay: a rectangle or a disc, without a box that nothing may touch.
#pragma once

#include <algorithm>

#include "sillon/settings/project.hpp"

namespace sillon {

/// Area of a bed. The excluded box is its zone.
class Bed {
 public:
  explicit Bed(const Printer& printer)
      : min_(printer.bedMin),
        max_(printer.bedMax),
        round_(printer.roundBed),
        zone_{printer.excludedMin, printer.excludedMax} {}

  [[nodiscard]] Vec2 centre() const { return 0.5 * (min_ + max_); }
  [[nodiscard]] double radius() const { return 0.5 * (max_.x - min_.x); }
  [[nodiscard]] bool hasZone() const { return zone_.max.x > zone_.min.x && zone_.max.y > zone_.min.y; }

  /// Distance by which a disc of radius `reach` around p sticks out over the bed [mm]; at most 0 on the bed.
  [[nodiscard]] double overhang(Vec2 p, double reach) const {
    if (round_) return length(p - centre()) + reach - radius();
    return std::max({min_.x - p.x, p.x - max_.x, min_.y - p.y, p.y - max_.y}) + reach;
  }

  /// Tells whether the box around p, `reach` to every side, touches the excluded box.
  [[nodiscard]] bool inZone(Vec2 p, double reach) const {
    return hasZone() && p.x + reach > zone_.min.x && p.x - reach < zone_.max.x && p.y + reach > zone_.min.y &&
           p.y - reach < zone_.max.y;
  }

  /// Tells whether a straight bead from a to b, `reach` to either side, touches the excluded box.
  [[nodiscard]] bool crossesZone(Vec2 a, Vec2 b, double reach) const {
    if (!hasZone()) return false;
    double enter = 0;
    double leave = 1;
    const auto clip = [&](double from, double along, double low, double high) {
      if (along == 0) return from > low && from < high;
      const double first = (low - from) / along;
      const double second = (high - from) / along;
      enter = std::max(enter, std::min(first, second));
      leave = std::min(leave, std::max(first, second));
      return enter < leave;
    };
    const Vec2 d = b - a;
    return clip(a.x, d.x, zone_.min.x - reach, zone_.max.x + reach) &&
           clip(a.y, d.y, zone_.min.y - reach, zone_.max.y + reach);
  }

 private:
  Vec2 min_;
  Vec2 max_;
  bool round_;
  Bounds zone_;
};

}  // namespace sillon
