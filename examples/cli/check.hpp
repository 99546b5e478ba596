// The result of sillon check as text.
#pragma once

#include <string>

#include "sillon/gcode_check.hpp"

namespace cli {

/// Facts, then one line per finding, then the verdict.
std::string checkText(const sillon::GcodeCheck& check);

}  // namespace cli
