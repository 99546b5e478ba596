// Formats the findings of a check of G-code, as JSON and as lines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sillon/gcode_reader/check.hpp"

namespace cli {

nlohmann::ordered_json findingsJson(const std::vector<sillon::GcodeFinding>& findings);

/// Returns a line for summaries: how long beads wait for their neighbours.
std::string delayLine(const sillon::NeighbourDelay& delay);

}  // namespace cli
