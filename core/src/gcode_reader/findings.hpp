// Makes findings: the one place where their codes, rules and sentences stand.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sillon/gcode_reader/finding.hpp"

namespace sillon {

using FindingValues = std::vector<std::pair<std::string, std::string>>;

/// \param code  one of the list in findings.cpp. \param values  for the sentence's {names}.
/// line and count are left to the caller.
GcodeFinding makeFinding(std::string_view code, bool error, FindingValues values = {});

/// Text of a file, as a sentence may show it: at most 60 characters, printable ASCII, quoted.
std::string shownText(std::string_view text);

}  // namespace sillon
