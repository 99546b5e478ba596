// Prusa's binary G-code, version 1: https://github.com/prusa3d/libbgcode/blob/main/doc/specifications.md
#pragma once

#include <string>
#include <string_view>

#include "sillon/base/result.hpp"

namespace sillon {

inline bool isBinaryGcode(std::string_view bytes) { return bytes.starts_with("GCDE"); }

/// All G-code of the file, then its settings and figures as comments. \return as readGcodeContainer.
Result<std::string> binaryToText(std::string_view file);

/// The file with the G-code of `text`, and with figures of its comments in the place of those of the same names.
/// \return as writeGcodeContainer.
Result<std::string> binaryWithText(std::string_view file, std::string_view text);

/// Undoes heatshrink, of a window of 2^windowBits bytes and runs of at most 2^4. \return at most `most` bytes.
std::string unshrunk(std::string_view data, int windowBits, std::size_t most);

/// Undoes MeatPack, and puts a blank before each word of a G command, which packing leaves out.
std::string unmeatpacked(std::string_view data);

}  // namespace sillon
