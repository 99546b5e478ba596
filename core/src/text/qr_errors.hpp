// Error for a text that fits into no QR code.
#pragma once

#include <cstddef>
#include <string>

#include "sillon/base/result.hpp"

namespace sillon {

inline Error qrTooLong(std::size_t bytes) {
  return {ErrorCode::TooLarge,
          "the text has " + std::to_string(bytes) +
              " bytes; no QR code of this correction holds it: shorten it, or lower the correction"};
}

}  // namespace sillon
