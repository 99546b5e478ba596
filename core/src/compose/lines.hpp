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

/// e^(2i angle): lines have no sense, so that means of these are means of lines.
Vec2f lineOf(double radians);

/// The line of a direction of any length > 0.
Vec2f lineAlong(Vec2 direction);

/// Line of a layer's beads at a place on the page.
using LineAt = std::function<Vec2f(Vec2 page)>;

/// Texel of a picture at a place in the layer's own millimetres.
/// \param size  of the layer's box; the picture is stretched over it.
template <class Picture>
std::optional<std::size_t> texelOf(const Picture& picture, Vec2 own, Vec2 size) {
  const double x = (own.x / size.x + 0.5) * picture.width, y = (0.5 - own.y / size.y) * picture.height;
  if (!(x >= 0 && y >= 0 && x < picture.width && y < picture.height)) return std::nullopt;
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
}

// Lines of each kind. What they refer to must outlive them.

LineAt mapLines(const LayerContent& content, const Placement& place);

/// The lines of a code's dark and light modules.
struct CodeLines {
  Vec2f dark;
  Vec2f light;
};
CodeLines codeLines(const CodeLayer& code);
LineAt codeLinesAt(const CodeLayer& code, const LayerContent& content, const Placement& place);

/// Along contours of equal distance from a shape's border, on cells of half a spacing.
Result<LineAt> alongLines(const Shape& shape, double spacing, const RunContext& run);

/// \param pattern  no echo.
LineAt patternLines(const PatternLayer& pattern, const Placement& place);

/// \param content  its picture is the decoded file, cropped.
LineAt tonesLines(const TonesLayer& tones, const LayerContent& content, const Placement& place, double spacing);

/// Lines that show pictures under their lamps, solved for within the layer's box and the surface.
/// \param known  of the plate before, whose lit tones are solved for anew; filled.
Result<LineAt> pictureLines(const Layer& layer, const LayerContent& content, const Placement& place,
                            const LayerPlate& plate, LayerPictures& known, const RunContext& run);

}  // namespace sillon
