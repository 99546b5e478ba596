#include "toolpath/path.hpp"

#include <optional>

#include "base/refused.hpp"

namespace sillon {
namespace {

// Tells whether low <= value <= high; false for NaN.
template <class T>
bool within(T value, T low, T high) {
  return value >= low && value <= high;
}

}  // namespace

std::optional<Error> pageDefect(Vec2 page) {
  if (within(page.x, 1e-3, 1e5) && within(page.y, 1e-3, 1e5)) return std::nullopt;
  return refusedArgument("PageOutOfRange", {{"width", page.x}, {"height", page.y}});
}

std::optional<Error> toolpathDefect(const Toolpath& toolpath, Vec2 page) {
  constexpr float kMaxWidth = 1000;
  if (std::optional<Error> defect = pageDefect(page)) return defect;
  // Points and widths must match, and all be finite and within bounds, as a caller may have changed them.
  for (const Cycle& cycle : toolpath.cycles) {
    // A width for each point, or those drawn would be read past the end.
    if (cycle.widths.size() != cycle.points.size()) {
      return refusedArgument("WidthsUnlikePoints", {{"points", cycle.points.size()}, {"widths", cycle.widths.size()}});
    }
    for (const Vec2f p : cycle.points) {
      if (!within(p.x, -1e5f, 1e5f) || !within(p.y, -1e5f, 1e5f)) {
        return refusedArgument("PathPointTooFar");
      }
    }
    for (const float width : cycle.widths) {
      if (!within(width, 0.0f, kMaxWidth)) return refusedArgument("BeadTooWide");
    }
  }
  return std::nullopt;
}

}  // namespace sillon
