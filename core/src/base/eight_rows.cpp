// Compiled for AVX2: no inline function of other files may be compiled here that linkers could take for all.
#include "base/capsule_rows.hpp"
#include "base/row_masks.hpp"

#if defined(SILLON_AVX2)

#include "base/capsule_row_loops.hpp"
#include "base/eight_lanes.hpp"

namespace sillon {
namespace {

__m256i load(const RowMask* two) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(two)); }
void store(RowMask* two, __m256i v) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(two), v); }

__m256i firstPixels(const std::int32_t* n) {
  const auto* table = reinterpret_cast<const __m128i*>(kFirstPixels.data());
  return _mm256_set_m128i(_mm_load_si128(table + n[1]), _mm_load_si128(table + n[0]));
}

}  // namespace

void pixelsByEight(const Capsule& capsule, int y, int count, int columns, PixelRuns& runs) {
  pixelsBy<Eight>(capsule, y, count, columns, runs);
}

void addRunsByTwo(const PixelRuns& runs, int count, RowMask* rows) {
  for (int k = 0; k < count; k += 2) {
    const __m256i run = _mm256_andnot_si256(firstPixels(runs.begin + k), firstPixels(runs.end + k));
    store(rows + k, _mm256_or_si256(load(rows + k), run));
  }
}

void addRowsByTwo(const RowMask* from, int count, RowMask* rows) {
  for (int k = 0; k < count; k += 2) store(rows + k, _mm256_or_si256(load(rows + k), load(from + k)));
}

bool rowsMeetByTwo(const RowMask* some, const RowMask* others, int count) {
  __m256i met = _mm256_setzero_si256();
  for (int k = 0; k < count; k += 2) met = _mm256_or_si256(met, _mm256_and_si256(load(some + k), load(others + k)));
  return _mm256_testz_si256(met, met) == 0;
}

}  // namespace sillon

#endif
