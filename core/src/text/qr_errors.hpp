// Error for a text that fits into no QR code.
#pragma once

#include <cstddef>

#include "base/refused.hpp"

namespace sillon {

inline Error qrTooLong(std::size_t bytes) { return refused(ErrorCode::TooLarge, "QrTooLong", {{"bytes", bytes}}); }

}  // namespace sillon
