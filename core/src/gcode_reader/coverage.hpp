// Coverage of oriented layers, and the beads' waits for their neighbours.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/gcode_reader/check.hpp"

namespace sillon {

// A raster of the cells that beads lie on.

/// Square cells over a box, at most 4 million of them.
class BeadRaster {
 public:
  using Bits = std::vector<std::uint64_t>;  ///< one bit per cell, set if a bead lies on its centre

  /// \param finest  side of the cells [mm], > 0; a box that would have more than 4 million of them gets larger ones.
  BeadRaster(const Bounds& box, double finest);

  /// A raster without any bead.
  [[nodiscard]] Bits none() const { return Bits(rowWords_ * rows_, 0); }

  /// Sets the cells of a bead, a rectangle with round ends. \param width  [mm]. \return number of cells that it
  /// visited.
  std::int64_t draw(Vec2f from, Vec2f to, double width, Bits& bits) const;

  /// Sets the cells of a row whose centres lie between two x [mm].
  void fill(int row, double begin, double end, Bits& bits) const;

  [[nodiscard]] std::int64_t cells() const { return static_cast<std::int64_t>(columns_) * rows_; }
  [[nodiscard]] double cell() const { return cell_; }                   ///< side of a cell [mm]
  [[nodiscard]] double firstY() const { return min_.y + 0.5 * cell_; }  ///< y of the centres of the lowest row [mm]
  [[nodiscard]] int rows() const { return rows_; }

 private:
  Vec2 min_;
  double cell_ = 0;
  double perMm_ = 0;  ///< cells per mm
  int columns_ = 0;
  int rows_ = 0;
  std::size_t rowWords_ = 0;
};

/// Counts the cells that are set.
std::int64_t countOf(const BeadRaster::Bits& bits);

// Share of the layers below that an oriented layer covers, in a file that was read.

/// A bead as a file describes it; lengths in mm.
struct LaidBead {
  Vec2f from;
  Vec2f to;
  float width = 0;
  bool base = false;  ///< true: a base layer's; false: an oriented layer's
  int layer = 0;      ///< number of its layer, ascending
  float top = 0;
  float begin = 0;    ///< time of its start [s]
  float seconds = 0;  ///< time it takes [s]
};

/// Finds the end of the stack that begins here: a new stack begins where a layer lies no higher than the one before it.
const LaidBead* stackEnd(const LaidBead* begin, const LaidBead* end);

/// Measures which share of the area of a stack's base layers each of its oriented layers covers, in the order of the
/// file. -1 stands for a stack without base layers, whose outline is unknown, and for all that would take more than a
/// second. Beads are rectangles with round ends on a raster of 0.05 mm, coarser for plates above 100 cm².
std::vector<double> orientedCoverage(const std::vector<LaidBead>& beads);

/// Measures how long oriented beads wait for their neighbours, in the lowest and the highest layer of each stack.
/// Places without a neighbour are not counted. \return nothing if no place has a neighbour.
std::optional<NeighbourDelay> neighbourDelay(const std::vector<LaidBead>& beads);

}  // namespace sillon
