// The "Quite OK" picture format (qoiformat.org), which Prusa's printers show.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sillon {

/// \param rgb  width * height * 3 bytes, row 0 on top; both sides > 0.
std::vector<std::uint8_t> encodeQoi(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace sillon
