// How much of what lies below it an oriented layer of a read file covers.
#pragma once

#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

/// A bead as a file tells it, all [mm].
struct LaidBead {
  Vec2f from;
  Vec2f to;
  float width = 0;
  bool base = false;  ///< else oriented
  int layer = 0;      ///< ascending
  float top = 0;
};

/// Share of the area of all base layers of a stack that each of its oriented layers covers, in the order of the file. A
/// new stack begins where a layer lies no higher than the one before it. Nothing tells the outline of a stack without
/// base layers: -1; likewise where it would take more than a second. Beads are rectangles with round ends on a
/// raster of 0.05 mm, coarser for plates above 100 cm².
std::vector<double> orientedCoverage(const std::vector<LaidBead>& beads);

}  // namespace sillon
