// .gcode.3mf: G-code in the zip that Bambu printers and their slicers take.
#pragma once

#include <string>
#include <string_view>

#include "sillon/result.hpp"

namespace sillon {

/// The zip, uncompressed, with Metadata/plate_1.gcode, its MD5 that the firmware checks, the file's largest PNG
/// thumbnail and what the file's own comments say of time and filament. The same bytes for the same file. Not tried on
/// a printer. \return TooLarge above 1 GiB.
Result<std::string> packGcode(std::string_view gcode);

/// The G-code of a .gcode.3mf, of the first plate if there are several; other bytes are returned as they are.
/// \return InvalidFile for a zip that is damaged, encrypted or holds no G-code; TooLarge above 256 MiB.
Result<std::string> unpackGcode(std::string_view bytes);

}  // namespace sillon
