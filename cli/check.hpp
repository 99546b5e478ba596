// The result of sillon check as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sillon/gcode_reader/check.hpp"

namespace cli {

/// Facts, then one line per finding, then the verdict.
std::string checkText(const sillon::GcodeCheck& check, const std::vector<std::string>& unchecked);

/// Each with code, rule, error, line, count, values and message.
nlohmann::ordered_json findingsJson(const std::vector<sillon::GcodeFinding>& findings);

/// The same with the names of the npm package's GcodeCheck; what is unknown is null.
std::string checkJson(const sillon::GcodeCheck& check, const std::vector<std::string>& unchecked);

}  // namespace cli
