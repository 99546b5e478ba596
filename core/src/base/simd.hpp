// Four floats at a time, with one source for SSE2, NEON and WebAssembly. It only uses lane-wise IEEE operations, so
// that lanes and platforms cannot change a result. The compilers' vector types suffice; a library would only add
// dispatch. All functions are noexcept: in WebAssembly, calls that may throw go through JavaScript, which cannot pass a
// vector on.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__ARM_NEON) && defined(__aarch64__)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace sillon {

#if defined(__GNUC__) || defined(__clang__)

using F4 = float __attribute__((vector_size(16)));
using I4 = std::int32_t __attribute__((vector_size(16)));
using U2 = std::uint64_t __attribute__((vector_size(16)));

inline F4 splat(float v) noexcept { return F4{v, v, v, v}; }
inline I4 splatInt(std::int32_t v) noexcept { return I4{v, v, v, v}; }
#if defined(__wasm_simd128__)
// Uses the intrinsic, because the compiler's own code would compare the mask with zero first.
inline F4 select4(I4 mask, F4 a, F4 b) noexcept { return (F4)wasm_v128_bitselect((v128_t)a, (v128_t)b, (v128_t)mask); }
#else
inline F4 select4(I4 mask, F4 a, F4 b) noexcept { return mask ? a : b; }
#endif
inline F4 toFloat(I4 v) noexcept { return __builtin_convertvector(v, F4); }
inline I4 toInt(F4 v) noexcept { return __builtin_convertvector(v, I4); }  // rounds towards zero

#else
// The same types as structs with plain loops, for compilers without vector types.
struct I4 {
  std::int32_t lane[4];
  std::int32_t operator[](int k) const { return lane[k]; }
};
struct F4 {
  float lane[4];
  float operator[](int k) const { return lane[k]; }
  float& operator[](int k) { return lane[k]; }
};
struct U2 {
  std::uint64_t lane[2];
  std::uint64_t operator[](int k) const { return lane[k]; }
};
inline U2 operator|(U2 a, U2 b) noexcept { return {{a.lane[0] | b.lane[0], a.lane[1] | b.lane[1]}}; }
inline U2 operator&(U2 a, U2 b) noexcept { return {{a.lane[0] & b.lane[0], a.lane[1] & b.lane[1]}}; }
inline U2 operator~(U2 a) noexcept { return {{~a.lane[0], ~a.lane[1]}}; }
#define SILLON_LANES(Out, expression)                     \
  Out out;                                                \
  for (int k = 0; k < 4; ++k) out.lane[k] = (expression); \
  return out
inline F4 splat(float v) noexcept { return F4{{v, v, v, v}}; }
inline I4 splatInt(std::int32_t v) noexcept { return I4{{v, v, v, v}}; }
inline F4 operator+(F4 a, F4 b) noexcept { SILLON_LANES(F4, a.lane[k] + b.lane[k]); }
inline F4 operator-(F4 a, F4 b) noexcept { SILLON_LANES(F4, a.lane[k] - b.lane[k]); }
inline F4 operator*(F4 a, F4 b) noexcept { SILLON_LANES(F4, a.lane[k] * b.lane[k]); }
inline F4 operator/(F4 a, F4 b) noexcept { SILLON_LANES(F4, a.lane[k] / b.lane[k]); }
inline F4 operator-(F4 a) noexcept { SILLON_LANES(F4, -a.lane[k]); }
inline I4 operator<(F4 a, F4 b) noexcept { SILLON_LANES(I4, a.lane[k] < b.lane[k] ? -1 : 0); }
inline I4 operator>(F4 a, F4 b) noexcept { SILLON_LANES(I4, a.lane[k] > b.lane[k] ? -1 : 0); }
inline I4 operator<(I4 a, I4 b) noexcept { SILLON_LANES(I4, a.lane[k] < b.lane[k] ? -1 : 0); }
inline I4 operator>(I4 a, I4 b) noexcept { SILLON_LANES(I4, a.lane[k] > b.lane[k] ? -1 : 0); }
inline I4 operator==(I4 a, I4 b) noexcept { SILLON_LANES(I4, a.lane[k] == b.lane[k] ? -1 : 0); }
inline I4 operator!=(I4 a, I4 b) noexcept { SILLON_LANES(I4, a.lane[k] != b.lane[k] ? -1 : 0); }
inline I4 operator+(I4 a, I4 b) noexcept { SILLON_LANES(I4, a.lane[k] + b.lane[k]); }
inline I4 operator-(I4 a, I4 b) noexcept { SILLON_LANES(I4, a.lane[k] - b.lane[k]); }
inline I4 operator&(I4 a, I4 b) noexcept { SILLON_LANES(I4, a.lane[k] & b.lane[k]); }
inline I4 operator|(I4 a, I4 b) noexcept { SILLON_LANES(I4, a.lane[k] | b.lane[k]); }
inline I4 operator~(I4 a) noexcept { SILLON_LANES(I4, ~a.lane[k]); }
inline F4 select4(I4 m, F4 a, F4 b) noexcept { SILLON_LANES(F4, m.lane[k] ? a.lane[k] : b.lane[k]); }
inline F4 toFloat(I4 v) noexcept { SILLON_LANES(F4, static_cast<float>(v.lane[k])); }
inline I4 toInt(F4 v) noexcept { SILLON_LANES(I4, static_cast<std::int32_t>(v.lane[k])); }
#undef SILLON_LANES
#endif

inline F4 load4(const float* p) noexcept {
  F4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline I4 load4(const std::int32_t* p) noexcept {
  I4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline I4 loadInt4(const std::uint32_t* p) noexcept {
  I4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void storeInt4(std::uint32_t* p, I4 v) noexcept { std::memcpy(p, &v, sizeof v); }
inline void store4(float* p, F4 v) noexcept { std::memcpy(p, &v, sizeof v); }
inline void store4(std::int32_t* p, I4 v) noexcept { std::memcpy(p, &v, sizeof v); }

/// Square roots, correctly rounded on every platform. The vector types have none, hence the intrinsics.
inline F4 sqrt4(F4 v) noexcept {
#if defined(__SSE2__) && (defined(__GNUC__) || defined(__clang__))
  return (F4)_mm_sqrt_ps((__m128)v);
#elif defined(__ARM_NEON) && defined(__aarch64__)
  return (F4)vsqrtq_f32((float32x4_t)v);
#elif defined(__wasm_simd128__)
  return (F4)wasm_f32x4_sqrt((v128_t)v);
#else
  float lane[4] = {std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
  return load4(lane);
#endif
}

// Maximum and minimum by lane. If the operands are equal, or if either is NaN, the result is b.
#if defined(__wasm_simd128__)
inline F4 max4(F4 a, F4 b) noexcept { return (F4)wasm_f32x4_pmax((v128_t)b, (v128_t)a); }
inline F4 min4(F4 a, F4 b) noexcept { return (F4)wasm_f32x4_pmin((v128_t)b, (v128_t)a); }
#elif defined(__SSE2__) && (defined(__GNUC__) || defined(__clang__))
inline F4 max4(F4 a, F4 b) noexcept { return (F4)_mm_max_ps((__m128)a, (__m128)b); }
inline F4 min4(F4 a, F4 b) noexcept { return (F4)_mm_min_ps((__m128)a, (__m128)b); }
#else
inline F4 max4(F4 a, F4 b) noexcept { return select4(a > b, a, b); }
inline F4 min4(F4 a, F4 b) noexcept { return select4(a < b, a, b); }
#endif
inline F4 abs4(F4 a) noexcept { return max4(a, -a); }

}  // namespace sillon
