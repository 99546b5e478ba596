// Cover of the laid beads.
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
  using Bits = std::vector<std::uint64_t>;  ///< one bit per cell: whether something lies on its centre

  /// \param finest  side of the cells where they are not too many [mm], > 0.
  BeadRaster(const Bounds& box, double finest);

  [[nodiscard]] Bits none() const { return Bits(rowWords_ * static_cast<std::size_t>(rows_), 0); }

  /// A rectangle with round ends. \param width  [mm]. \return how many cells it has looked at.
  std::int64_t draw(Vec2f from, Vec2f to, double width, Bits& bits) const;

  /// The cells of a row from one x to another [mm].
  void fill(int row, double begin, double end, Bits& bits) const;

  [[nodiscard]] std::int64_t cells() const { return static_cast<std::int64_t>(columns_) * rows_; }
  [[nodiscard]] double cell() const { return cell_; }                   ///< side of a cell [mm]
  [[nodiscard]] double firstY() const { return min_.y + 0.5 * cell_; }  ///< of the centres of the lowest row
  [[nodiscard]] int rows() const { return rows_; }

 private:
  Vec2 min_;
  double cell_ = 0;
  double perMm_ = 0;  ///< cells
  int columns_ = 0;
  int rows_ = 0;
  std::size_t rowWords_ = 0;
};

/// Counts the cells that are set.
std::int64_t countOf(const BeadRaster::Bits& bits);

// Cover of an oriented layer over what lies below it, in a file that was read.

/// A bead as a file tells it, all [mm].
struct LaidBead {
  Vec2f from;
  Vec2f to;
  float width = 0;
  bool base = false;  ///< else oriented
  int layer = 0;      ///< ascending
  float top = 0;
  float begin = 0;    ///< when it is begun [s]
  float seconds = 0;  ///< it takes
};

/// The end of the stack that begins here: a new one begins where a layer lies no higher than the one before it.
const LaidBead* stackEnd(const LaidBead* begin, const LaidBead* end);

/// Share of the area of all base layers of a stack that each of its oriented layers covers, in the order of the file.
/// Nothing tells the outline of a stack without
/// base layers: -1; likewise where it would take more than a second. Beads are rectangles with round ends on a
/// raster of 0.05 mm, coarser for plates above 100 cm².
std::vector<double> orientedCoverage(const std::vector<LaidBead>& beads);

/// Measures the wait of oriented beads for their neighbours, in the lowest and the highest layer of each stack. Places
/// without a neighbour are not counted.
/// \return nothing where no place has a neighbour.
std::optional<NeighbourDelay> neighbourDelay(const std::vector<LaidBead>& beads);

}  // namespace sillon
