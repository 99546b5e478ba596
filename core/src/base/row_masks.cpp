#include "base/row_masks.hpp"

namespace sillon {

void addRuns(const PixelRuns& runs, int count, RowMask* rows) {
#if defined(SILLON_AVX2)
  if (eightAtOnce) return addRunsByTwo(runs, count, rows);
#endif
  for (int k = 0; k < count; ++k) rows[k] = rows[k] | rowOf(runs.begin[k], runs.end[k]);
}

void addRows(const RowMask* from, int count, RowMask* rows) {
#if defined(SILLON_AVX2)
  if (eightAtOnce) return addRowsByTwo(from, count, rows);
#endif
  for (int k = 0; k < count; ++k) rows[k] = rows[k] | from[k];
}

bool rowsMeet(const RowMask* some, const RowMask* others, int count) {
#if defined(SILLON_AVX2)
  if (eightAtOnce) return rowsMeetByTwo(some, others, count);
#endif
  RowMask met{};
  for (int k = 0; k < count; ++k) met = met | (some[k] & others[k]);
  return (met[0] | met[1]) != 0;
}

}  // namespace sillon
