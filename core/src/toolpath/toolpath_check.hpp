// What the drawings expect of a toolpath: they may get one that somebody changed.
#pragma once

#include <string>

#include "sillon/base/types.hpp"

namespace sillon {

/// Why the toolpath or its page [mm] cannot be drawn; empty if they can.
inline std::string toolpathDefect(const Toolpath& toolpath, Vec2 page) {
  constexpr float kMaxWidth = 1000;
  const auto within = [](auto v, auto low, auto high) { return v >= low && v <= high; };  // false for NaN
  if (!within(page.x, 1e-3, 1e5) || !within(page.y, 1e-3, 1e5)) {
    return "page is outside its range of 0.001 to 100000 mm per side";
  }
  for (const Cycle& cycle : toolpath.cycles) {
    if (cycle.widths.size() != cycle.points.size()) {
      return "toolpath has a cycle with " + std::to_string(cycle.points.size()) + " points and " +
             std::to_string(cycle.widths.size()) + " widths; there must be as many";
    }
    for (const Vec2f p : cycle.points) {
      if (!within(p.x, -1e5f, 1e5f) || !within(p.y, -1e5f, 1e5f)) {
        return "toolpath has a point outside -100000 to 100000 mm";
      }
    }
    for (const float width : cycle.widths) {
      if (!within(width, 0.0f, kMaxWidth)) return "toolpath has a bead width outside 0 to 1000 mm";
    }
  }
  return {};
}

}  // namespace sillon
