// What the drawings expect of a toolpath: they may get one that somebody changed.
#pragma once

#include <string>

#include "sillon/base/types.hpp"

namespace sillon {

/// Why no plate can have this page [mm]; empty if one can.
std::string pageDefect(Vec2 page);

/// Why the toolpath or its page [mm] cannot be drawn; empty if they can.
std::string toolpathDefect(const Toolpath& toolpath, Vec2 page);

}  // namespace sillon
