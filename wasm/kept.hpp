// Values that stay in the engine for later calls, under numbers that the host gives: nothing of it has
// to be handed out and back in. The host is told of what is there after each call, and hands over what is not.
#pragma once

#include <emscripten/val.h>

#include <string>
#include <vector>

#include "sillon/base/types.hpp"

namespace kept {

/// The last plate, and the path of the layer below it: more than two are not kept. The same beads once more take
/// another number besides. \param number  > 0
void keep(int number, sillon::Toolpath toolpath);

/// \param js  a toolpath whose `cycles` are {number, value}; without the value they are those of that number. The
/// result is good until two others are kept.
const sillon::Toolpath& toolpathOf(const emscripten::val& js);

/// The last G-code that was written. \param number  > 0
void keep(int number, std::string gcode);

const std::string& gcodeOf(int number);

/// Numbers of the beads and the G-code that are kept.
std::vector<int> numbers();

}  // namespace kept
