// Compiled for AVX2: no inline function of other files may be compiled here that linkers could take for all.
#include "field/phase_rows.hpp"

#if defined(SILLON_AVX2)

#include "base/eight_lanes.hpp"
#include "field/phase_row_loops.hpp"

namespace sillon {

void fillEdgesByEight(const EdgeRow& row, int cells) { fillEdgesBy<Eight>(row, cells); }

void sweepCellsByEight(const ColourSweep& sweep, std::size_t first, int cells) {
  sweepCellsBy<Eight>(sweep, first, cells);
}

}  // namespace sillon

#endif
