// What the system has of memory, and one setting of the C library, for programs that make plates.
#pragma once

#include <climits>

#if defined(__linux__)
#include <malloc.h>
#endif

namespace cli {

/// Keeps freed blocks in the process. By default glibc gives blocks above 32 MB back at once, and the kernel must clear
/// their pages anew for every stage: measured on 16 million cells, a third of the whole time.
inline void keepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

/// Memory that this process may still take [bytes]; infinite where the system does not tell.
double freeMemory();

/// Of it, what a plate may take while it is made: report, G-code and preview raise the peak from 120 to 140 bytes a
/// cell (2 million cells, 280 mm at 0.4 mm).
inline double memoryForPlates() { return 0.8 * freeMemory(); }

}  // namespace cli
