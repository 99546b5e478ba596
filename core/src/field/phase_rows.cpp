#include "field/phase_rows.hpp"

#include "base/simd.hpp"
#include "field/phase_row_loops.hpp"

namespace sillon {

void fillEdges(const EdgeRow& row, int cells) {
#if defined(SILLON_AVX2)
  if (eightAtOnce) return fillEdgesByEight(row, cells);
#endif
  fillEdgesBy<Four>(row, cells);
}

void sweepCells(const ColourSweep& sweep, std::size_t first, int cells) {
#if defined(SILLON_AVX2)
  if (eightAtOnce) return sweepCellsByEight(sweep, first, cells);
#endif
  sweepCellsBy<Four>(sweep, first, cells);
}

}  // namespace sillon
