// Findings of a reader of G-code as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "sillon/gcode_reader/check.hpp"

namespace cli {

nlohmann::ordered_json findingsJson(const std::vector<sillon::GcodeFinding>& findings);

}  // namespace cli
