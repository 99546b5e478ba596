// One layer as directions and cover on a raster.
#pragma once

#include <vector>

#include "compose/content.hpp"
#include "compose/placement.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// The plate that layers lie on.
struct LayerPlate {
  const Project& project;
  const Shape& shape;
  int width = 0;  ///< of the raster
  int height = 0;
};

/// e^(2i angle): lines have no sense, so that means of these are means of lines.
Vec2f lineOf(double radians);

/// The lines of a code's dark and light modules.
struct CodeLines {
  Vec2f dark;
  Vec2f light;
};
CodeLines codeLines(const Layer& layer);

using Cells = std::vector<char>;

/// Cells where a layer shows: its mask, and in it letters and drawings where nothing is behind them.
struct Region {
  Cells shown;
  Cells content;  ///< letters or a drawing among them; empty: all
};

/// Tells whether a layer has letters or a drawing, which a ground may surround.
constexpr bool outlined(LayerKind kind) { return kind == LayerKind::Text || kind == LayerKind::Drawing; }

/// Tells whether a layer lies where the plate is, wherever its middle is.
bool unbounded(const Layer& layer);

Region regionOf(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate);

/// Cells of the plate within a distance of its border [mm].
Cells borderCells(const LayerPlate& plate, double width);

/// Draws a layer over those below it, and fills LayerStack::pictures and LayerStack::inks.
/// \param number  of the layer.
/// \return the errors of solveDirections, or Cancelled.
std::optional<Error> drawLayer(std::size_t number, const LayerContent& content, const Placement& place,
                               const LayerPlate& plate, LayerStack& stack, const RunContext& run);

/// Share of a shape that is narrower than two beads: what an opening by a disc of one bead's radius takes from it, less
/// what it takes from corners.
double thinShare(const Shape& shape, double spacing);

}  // namespace sillon
