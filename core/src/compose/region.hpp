// Cells of the surface where a layer shows.
#pragma once

#include <vector>

#include "compose/content.hpp"
#include "compose/placement.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

using Cells = std::vector<char>;

/// Cells where a layer shows: its mask, and within it only letters or the drawing if the layer has no ground.
struct Region {
  Cells shown;
  Cells content;  ///< cells of letters or a drawing among them; empty: all cells
};

/// Tells whether a layer has letters or a drawing, which a ground may surround.
bool outlined(const Layer& layer);

/// Tells whether a layer covers the plate regardless of its own place.
bool unbounded(const Layer& layer);

Region regionOf(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate);

/// Returns the cells of the plate within a distance of its border [mm].
Cells borderCells(const LayerPlate& plate, double width);

/// Returns the share of a layer in each cell: 1 inside, 0 outside, with a ramp over the width `soft` of its edge [mm].
std::vector<float> coverOf(const Cells& shown, const LayerPlate& plate, double soft);

}  // namespace sillon
