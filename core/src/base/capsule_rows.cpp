#include "base/capsule_rows.hpp"

#include "base/capsule_row_loops.hpp"
#include "base/simd.hpp"

namespace sillon {

void pixelsOf(const Capsule& capsule, int y, int count, int columns, PixelRuns& runs) {
#if defined(SILLON_AVX2)
  if (eightAtOnce) return pixelsByEight(capsule, y, count, columns, runs);
#endif
  pixelsBy<Four>(capsule, y, count, columns, runs);
}

}  // namespace sillon
