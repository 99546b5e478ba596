// Formats the findings of a check of G-code, as JSON and as lines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sillon/gcode_reader/check.hpp"

namespace sillon::cli {

nlohmann::ordered_json findingsJson(const std::vector<GcodeFinding>& findings);

/// Returns a line for summaries: how long beads wait for their neighbours.
std::string delayLine(const NeighbourDelay& delay);

}  // namespace sillon::cli
