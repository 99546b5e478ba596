// What a slow board can follow: fewer moves where they come thick, then speeds that change as little as they may.
#pragma once

#include <vector>

#include "gcode/motion.hpp"

namespace sillon {

/// Joins moves to longer ones where the path would otherwise be slowed by maxSegmentsPerSecond. Points left out lie
/// within 10 um of the line that replaces them, and widths within 0.08 mm of the one that is written there: both as
/// little as it takes. The plastic of what is joined is the sum of its parts. Paths that a board can follow stay as
/// they are.
void joinMoves(Motion& motion, const MotionLimits& limits);

/// Speed per segment that no 8 moves in a row pass the board faster than it takes. \return counts what is slowed.
std::vector<double> boardSpeeds(Motion& motion, const MotionLimits& limits);

}  // namespace sillon
