// QR codes: their modules, and whether decoders read them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/refused.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

/// Makes the modules of the smallest QR code for a text (ISO/IEC 18004), one grey texel each: 0
/// dark, 65535 light; row 0 on top, without the quiet zone. The correction is raised where that
/// takes no larger code.
/// \param read  called only by engines in browsers, which take the code from JavaScript.
/// \return TooLarge for a text that no code holds.
Result<Image> qrModules(const std::string& text, QrCorrection correction, const ReadInput& read);

/// Light modules around a code, on each side (ISO/IEC 18004).
inline constexpr int kQuietZone = 4;

/// Tells whether decoders read a code some of whose modules are seen wrongly. They do if its finder
/// patterns are whole, with light beside their middles, one copy of its format has at most three
/// wrong modules, and no block has more wrong codewords than half of its words of correction.
/// \param code  modules as qrModules makes them, inside its quiet zone.
/// \param wrong  one entry per module of `code`.
bool qrReads(const Image& code, const std::vector<char>& wrong);

/// Makes the error for a text that fits into no QR code.
inline Error qrTooLong(std::size_t bytes) { return refused(ErrorCode::TooLarge, "QrTooLong", {{"bytes", bytes}}); }

}  // namespace sillon
