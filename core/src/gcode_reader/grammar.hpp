// The grammar of the lines that are written here: what every firmware, host and viewer reads alike
// (docs/reference/gcode.md).
#pragma once

#include <string_view>

namespace sillon {

/// ["-"] ("0" | nonzero { digit }) ["." digit { digit }], but no "-0", "-0.000".
bool isPlainNumber(std::string_view text);

/// ("G"|"M"|"T") number { " " LETTER [number] }, no letter twice; or NAME { " " NAME "=" (number | NAME) }.
bool isPlainCommand(std::string_view text);

/// The code of the finding about a line without its end, or null: it must be printable ASCII; empty, a comment, or a
/// command of less than 96 characters that a comment may follow.
const char* lineFault(std::string_view line);

}  // namespace sillon
