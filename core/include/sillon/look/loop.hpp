// The loop of moving light that people send to one another: where the lamp stands in each of its
// pictures.
#pragma once

#include <span>
#include <vector>

#include "sillon/look/appearance.hpp"

namespace sillon {

struct LoopFrame {
  Lamp lamp;
  int milliseconds = 0;  ///< that it is shown
};

/// One lamp goes round once; several are held in turn, with a quick way to the next. The last frame
/// leads to the first.
/// \param lamps  of the plate's pictures; not empty.
std::vector<LoopFrame> loopFrames(std::span<const Lamp> lamps);

/// The usual bounds of a loop that is sent: its longer side [pixels], and the most bytes that
/// messengers take well.
int loopSide();
int loopBytes();

/// Qualities of lossy pictures that are tried until the loop is small enough, best first, 0..100.
std::vector<int> loopQualities();

}  // namespace sillon
