// Free memory of the system, and a setting of the C library for programs that make plates.
#pragma once

#include <climits>

#if defined(__linux__)
#include <malloc.h>
#endif

namespace sillon::cli {

/// Keeps freed blocks in the process. By default glibc returns blocks above 32 MB at once, and the kernel must clear
/// their pages anew for every stage: a third of the whole time, measured on 16 million cells.
inline void keepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

/// Returns the memory that this process may still take [bytes]; infinite if the system does not tell.
double freeMemory();

/// Returns the memory that a plate may take while it is made. The rest is a reserve for report, G-code and preview,
/// which raise the peak from 120 to 140 bytes per cell (2 million cells, 280 mm at 0.4 mm).
inline double memoryForPlates() { return 0.8 * freeMemory(); }

}  // namespace sillon::cli
