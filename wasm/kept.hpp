// Values that stay in the engine for later calls, under numbers from the host, so that they need not be handed out and
// back in. After each call the host learns which values are kept, and hands over the others.
#pragma once

#include <emscripten/val.h>

#include <string>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon::bindings::kept {

/// Keeps the beads of a plate; at most two plates are kept, such as the last one and the path of the layer below it. If
/// the same beads are kept already, they only get a further number. \param number  > 0
void keep(int number, Toolpath toolpath);

/// Returns a toolpath, which is valid until two others are kept.
/// \param js  a toolpath whose `cycles` are {number, value}; without the value, the beads kept under the number are
/// used.
const Toolpath& toolpathOf(const emscripten::val& js);

/// Keeps the last G-code that was written. \param number  > 0
void keep(int number, std::string gcode);

const std::string& gcodeOf(int number);

/// Returns the numbers of the kept beads and G-code.
std::vector<int> numbers();

}  // namespace sillon::bindings::kept
