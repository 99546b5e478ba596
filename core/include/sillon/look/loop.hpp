// The loop of moving light that people send to one another: the position of the lamp in each of its
// frames.
#pragma once

#include <span>
#include <vector>

#include "sillon/look/appearance.hpp"

namespace sillon {

/// One frame of the loop.
struct LoopFrame {
  Lamp lamp;
  int milliseconds = 0;  ///< time for which it is shown
};

/// Makes the frames of a loop. One lamp goes round once; several are held in turn, with a quick way
/// to the next. The last frame leads to the first.
/// \param lamps  lamps of the plate's pictures; not empty.
std::vector<LoopFrame> loopFrames(std::span<const Lamp> lamps);

/// Returns the usual longer side of a loop that is sent [pixels].
int loopSide();
/// Returns the most bytes of a loop that messengers take well.
int loopBytes();

/// Lists the qualities of lossy pictures that are tried until the loop is small enough, best first,
/// 0..100.
std::vector<int> loopQualities();

}  // namespace sillon
