#include "toolpath/path.hpp"

#include "base/numbers.hpp"

namespace sillon {
namespace {

// Tells whether low <= value <= high; false for NaN.
template <class T>
bool within(T value, T low, T high) {
  return value >= low && value <= high;
}

}  // namespace

std::string pageDefect(Vec2 page) {
  if (within(page.x, 1e-3, 1e5) && within(page.y, 1e-3, 1e5)) return {};
  return "the page is " + shownNumber(page.x) + " x " + shownNumber(page.y) +
         " mm; both sides must be 0.001 to 100000 mm";
}

std::string toolpathDefect(const Toolpath& toolpath, Vec2 page) {
  constexpr float kMaxWidth = 1000;
  if (std::string defect = pageDefect(page); !defect.empty()) return defect;
  // Points and widths must match, and all be finite and within bounds, as a caller may have changed them.
  for (const Cycle& cycle : toolpath.cycles) {
    // A width for each point, or those drawn would be read past the end.
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
