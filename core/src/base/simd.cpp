#include "base/simd.hpp"

namespace sillon {

#if defined(SILLON_AVX2)
bool eightAtOnce = __builtin_cpu_supports("avx2") != 0;
#else
bool eightAtOnce = false;
#endif

}  // namespace sillon
