// Directions of a layer's beads, as lines without a sense.
#pragma once

#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>

#include "compose/content.hpp"
#include "compose/placement.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/compose/compose.hpp"

namespace sillon {

inline constexpr double kDegree = std::numbers::pi / 180;

/// Returns e^(2i angle). A line has no sense, and with the doubled angle the mean of such vectors is the mean of lines.
Vec2f lineOf(double radians);

/// Returns the line of a direction of any length > 0.
Vec2f lineAlong(Vec2 direction);

/// Function that returns the line of a layer's beads at a place on the page.
using LineAt = std::function<Vec2f(Vec2 page)>;

/// Returns the texel of a picture at a place in the layer's own millimetres; nothing outside.
/// \param size  size of the layer's box; the picture is stretched over it.
template <class Picture>
std::optional<std::size_t> texelOf(const Picture& picture, Vec2 own, Vec2 size) {
  const double x = (own.x / size.x + 0.5) * picture.width, y = (0.5 - own.y / size.y) * picture.height;
  if (!(x >= 0 && y >= 0 && x < picture.width && y < picture.height)) return std::nullopt;
  return indexOf(static_cast<int>(x), static_cast<int>(y), picture.width);
}

// Lines of each kind of layer. Their arguments must outlive the result.

LineAt mapLines(const LayerContent& content, const Placement& place);

/// Lines of a code's dark and light modules.
struct CodeLines {
  Vec2f dark;
  Vec2f light;
};
CodeLines codeLines(const CodeLayer& code);
LineAt codeLinesAt(const CodeLayer& code, const LayerContent& content, const Placement& place);

/// Returns lines along contours of equal distance from a shape's border, on cells of half a spacing.
Result<LineAt> alongLines(const Shape& shape, double spacing, const RunContext& run);

/// Returns the lines of a pattern. \param pattern  any pattern except Echo.
LineAt patternLines(const PatternLayer& pattern, const Placement& place);

/// Returns the lines for tones. \param content  content whose picture is the decoded, cropped file.
LineAt tonesLines(const TonesLayer& tones, const LayerContent& content, const Placement& place, double spacing);

/// Returns lines that show pictures under their lamps, solved for where the layer's box and the surface overlap.
/// \param known  pictures of the previous plate, whose tones are solved anew; filled if empty.
Result<LineAt> pictureLines(const Layer& layer, const LayerContent& content, const Placement& place,
                            const LayerPlate& plate, LayerPictures& known, const RunContext& run);

}  // namespace sillon
