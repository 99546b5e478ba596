// G-code as slicers spell it: capitals, one blank before each word, no zeros before a command's number.
#pragma once

#include <string>
#include <string_view>

namespace sillon {

/// \param line  trimmed. \return the same command in that spelling, with its comment; what is no G, M or T command, or
/// holds text, is left as it is.
std::string spelled(std::string_view line);

/// Whether it is spelled so already, as nearly all lines are.
bool isSpelled(std::string_view line);

}  // namespace sillon
