// Words for messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sillon {

/// Text from a file, fit to be shown: in quotes, on one line, at most 60 bytes.
std::string inQuotes(std::string_view text);

/// "did you mean ...?" with the nearest three, or "known are ..." with all if none is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace sillon
