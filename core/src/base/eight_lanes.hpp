// Eight floats at a time, for sources that are compiled for AVX2, and only for them. Nothing here has a name that
// linkers could take for that of another source. See simd.hpp for what each of `Four` does.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace sillon {
namespace {

using F8 = float __attribute__((vector_size(32)));
using I8 = std::int32_t __attribute__((vector_size(32)));

struct Eight {
  using F = F8;
  using I = I8;
  static constexpr int count = 8;

  static F load(const float* p) { return (F)_mm256_loadu_ps(p); }
  static I load(const std::int32_t* p) { return (I)_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)); }
  static void store(float* p, F v) { _mm256_storeu_ps(p, (__m256)v); }
  static void store(std::int32_t* p, I v) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), (__m256i)v); }
  static F all(float v) { return (F)_mm256_set1_ps(v); }
  static I all(std::int32_t v) { return (I)_mm256_set1_epi32(v); }
  static F select(I mask, F a, F b) { return mask ? a : b; }
  static F max(F a, F b) { return (F)_mm256_max_ps((__m256)a, (__m256)b); }
  static F min(F a, F b) { return (F)_mm256_min_ps((__m256)a, (__m256)b); }
  static F sqrt(F v) { return (F)_mm256_sqrt_ps((__m256)v); }
  static I toInt(F v) { return __builtin_convertvector(v, I); }
  static F toFloat(I v) { return __builtin_convertvector(v, F); }
};

}  // namespace
}  // namespace sillon
