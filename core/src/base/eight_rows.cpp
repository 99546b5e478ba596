// Compiled for AVX2: no inline function of other files may be compiled here that linkers could take for all.
#include "base/capsule_rows.hpp"

#if defined(SILLON_AVX2)

#include "base/capsule_row_loops.hpp"
#include "base/eight_lanes.hpp"

namespace sillon {

void pixelsByEight(const Capsule& capsule, int y, int count, int columns, PixelRuns& runs) {
  pixelsBy<Eight>(capsule, y, count, columns, runs);
}

}  // namespace sillon

#endif
