// Rows of 128 pixels, one bit each. They are taken two at a time: all counts of rows are even.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "base/capsule_rows.hpp"
#include "base/simd.hpp"

namespace sillon {

using RowMask = U2;
inline constexpr int kRowPixels = 128;

/// The first n pixels, for n from 0 to all of them.
alignas(RowMask) inline constexpr std::array<std::array<std::uint64_t, 2>, kRowPixels + 1> kFirstPixels = [] {
  std::array<std::array<std::uint64_t, 2>, kRowPixels + 1> first{};
  for (std::size_t n = 1; n < first.size(); ++n) {
    first[n] = first[n - 1];
    first[n][n <= 64 ? 0 : 1] |= std::uint64_t{1} << ((n - 1) % 64);
  }
  return first;
}();

/// The pixels from `begin` to `end`, the last one left out; none where end <= begin.
inline RowMask rowOf(int begin, int end) {
  RowMask before, upTo;
  std::memcpy(&before, &kFirstPixels[static_cast<std::size_t>(begin)], sizeof before);
  std::memcpy(&upTo, &kFirstPixels[static_cast<std::size_t>(end)], sizeof upTo);
  return upTo & ~before;
}

/// Adds run k to row k. \param count  up to PixelRuns::kMostRows
void addRuns(const PixelRuns& runs, int count, RowMask* rows);

/// Adds `count` rows to others.
void addRows(const RowMask* from, int count, RowMask* rows);

/// Whether any of `count` rows shares a pixel with its counterpart.
bool rowsMeet(const RowMask* some, const RowMask* others, int count);

/// The same with AVX2, which takes both rows of a pair at once (eightAtOnce).
void addRunsByTwo(const PixelRuns& runs, int count, RowMask* rows);
void addRowsByTwo(const RowMask* from, int count, RowMask* rows);
bool rowsMeetByTwo(const RowMask* some, const RowMask* others, int count);

}  // namespace sillon
