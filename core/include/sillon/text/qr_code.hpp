// QR codes.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

/// The modules of the smallest QR code for a text, one grey texel each: 0 dark, 65535 light; row 0
/// on top, without the quiet zone. The correction is raised where that takes no larger code
/// (ISO/IEC 18004). \param read  asked for it by engines in browsers alone, which take it from
/// JavaScript. \return TooLarge for a text that no code holds.
Result<Image> qrModules(const std::string& text, QrCorrection correction, const ReadInput& read);

/// Light modules around a code, on each side (ISO/IEC 18004).
inline constexpr int kQuietZone = 4;

/// Tells whether decoders read a code some of whose modules are seen wrongly: its finder patterns
/// are whole, with light beside their middles, one copy of its format has at most three wrong
/// modules, and no block more wrong codewords than half of its words of correction.
/// \param code  as of qrModules, inside its quiet zone.
/// \param wrong  one per module of `code`.
bool qrReads(const Image& code, const std::vector<char>& wrong);

}  // namespace sillon
