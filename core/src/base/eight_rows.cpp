// Compiled for AVX2: no inline function of other files may be compiled here that linkers could take for all.
#include "base/capsule_rows.hpp"
#include "base/row_masks.hpp"

#if defined(SILLON_AVX2)

#include "base/capsule_row_loops.hpp"
#include "base/eight_lanes.hpp"

namespace sillon {
namespace {

// Two rows. There is no third where the number of rows is odd: its place holds none, and is not written.
__m256i load(const RowMask* rows, bool two) {
  const __m128i first = _mm_loadu_si128(reinterpret_cast<const __m128i*>(rows));
  return two ? _mm256_loadu_si256(reinterpret_cast<const __m256i*>(rows)) : _mm256_zextsi128_si256(first);
}

void store(RowMask* rows, __m256i v, bool two) {
  if (two) return _mm256_storeu_si256(reinterpret_cast<__m256i*>(rows), v);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(rows), _mm256_castsi256_si128(v));
}

__m256i firstPixels(const std::int32_t* n, bool two) {
  const auto* table = reinterpret_cast<const __m128i*>(kFirstPixels.data());
  return _mm256_set_m128i(two ? _mm_load_si128(table + n[1]) : _mm_setzero_si128(), _mm_load_si128(table + n[0]));
}

}  // namespace

void pixelsByEight(const Capsule& capsule, int y, int count, int columns, PixelRuns& runs) {
  pixelsBy<Eight>(capsule, y, count, columns, runs);
}

void addRunsByTwo(const PixelRuns& runs, int count, RowMask* rows) {
  const auto add = [&](int k, bool two) {
    const __m256i run = _mm256_andnot_si256(firstPixels(runs.begin + k, two), firstPixels(runs.end + k, two));
    store(rows + k, _mm256_or_si256(load(rows + k, two), run), two);
  };
  int k = 0;
  for (; k + 1 < count; k += 2) add(k, true);
  if (k < count) add(k, false);
}

void addRowsByTwo(const RowMask* from, int count, RowMask* rows) {
  const auto add = [&](int k, bool two) {
    store(rows + k, _mm256_or_si256(load(rows + k, two), load(from + k, two)), two);
  };
  int k = 0;
  for (; k + 1 < count; k += 2) add(k, true);
  if (k < count) add(k, false);
}

bool rowsMeetByTwo(const RowMask* some, const RowMask* others, int count) {
  __m256i met = _mm256_setzero_si256();
  const auto add = [&](int k, bool two) {
    met = _mm256_or_si256(met, _mm256_and_si256(load(some + k, two), load(others + k, two)));
  };
  int k = 0;
  for (; k + 1 < count; k += 2) add(k, true);
  if (k < count) add(k, false);
  return _mm256_testz_si256(met, met) == 0;
}

}  // namespace sillon

#endif
