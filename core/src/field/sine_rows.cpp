#include "field/sine_rows.hpp"

#include "base/simd.hpp"
#include "field/sine_row_loops.hpp"

namespace sillon {

void fillPowers(const PowerRow& row, std::size_t cells) {
#if defined(SILLON_AVX2)
  if (eightAtOnce) return fillPowersByEight(row, cells);
#endif
  fillPowersBy<Four>(row, cells);
}

void addToNodes(const NodeSums& sums, std::size_t cells) {
#if defined(SILLON_AVX2)
  if (eightAtOnce) return addToNodesByEight(sums, cells);
#endif
  addToNodesBy<Four>(sums, cells);
}

}  // namespace sillon
