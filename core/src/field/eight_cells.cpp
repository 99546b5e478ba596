// Compiled for AVX2: no inline function of other files may be compiled here that linkers could take for all.
#include "field/phase_rows.hpp"
#include "field/sine_rows.hpp"

#if defined(SILLON_AVX2)

#include "base/eight_lanes.hpp"
#include "field/phase_row_loops.hpp"
#include "field/sine_row_loops.hpp"

namespace sillon {

void fillEdgesByEight(const EdgeRow& row, int cells) { fillEdgesBy<Eight>(row, cells); }

void sweepCellsByEight(const ColourSweep& sweep, std::size_t first, int cells) {
  sweepCellsBy<Eight>(sweep, first, cells);
}

void fillPowersByEight(const PowerRow& row, std::size_t cells) { fillPowersBy<Eight>(row, cells); }

void addToNodesByEight(const NodeSums& sums, std::size_t cells) { addToNodesBy<Eight>(sums, cells); }

}  // namespace sillon

#endif
