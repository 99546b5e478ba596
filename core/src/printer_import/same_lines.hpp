// Whether lines of a printed block say what a template says of them.
#pragma once

#include <cstddef>
#include <string_view>

namespace sillon {

bool isCommand(std::string_view line, std::string_view word);

std::string_view firstWord(std::string_view text);

/// Belongs to the print it was made for, and says nothing about ours.
bool isOfOldPrint(std::string_view line);

/// Of a text [bytes]; end is 0: none.
struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Where the lines of a block say the same, one by one and with no command between, as a template's: the same commands
/// with about the same numbers. The slicer knows the plate's edge, a donor tells its beads. \param told  the template
/// with the donor's own values.
Stretch whereSaid(std::string_view done, std::string_view told);

}  // namespace sillon
