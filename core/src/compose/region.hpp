// Cells of the surface where a layer shows.
#pragma once

#include <vector>

#include "compose/content.hpp"
#include "compose/placement.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

using Cells = std::vector<char>;

/// Cells where a layer shows: its mask, and in it letters and drawings where nothing is behind them.
struct Region {
  Cells shown;
  Cells content;  ///< letters or a drawing among them; empty: all
};

/// Tells whether a layer has letters or a drawing, which a ground may surround.
bool outlined(const Layer& layer);

/// Tells whether a layer lies where the plate is, wherever its middle is.
bool unbounded(const Layer& layer);

Region regionOf(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate);

/// Cells of the plate within a distance of its border [mm].
Cells borderCells(const LayerPlate& plate, double width);

/// Share that a layer has in each cell: 1 inside and 0 outside of it, and in between over the width of its soft edge
/// [mm].
std::vector<float> coverOf(const Cells& shown, const LayerPlate& plate, double soft);

}  // namespace sillon
