// Any bytes as a picture: as many pixels as its size says, or an error with a message.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "base/checksums.hpp"
#include "sillon/input/image_io.hpp"

namespace {

// Chance finds no checksum: without the right one of each chunk, nothing of a changed PNG would be decoded.
void mendChecksums(std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t kSignature = 8;
  const auto wordAt = [&](std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k) word = word << 8 | bytes[at + k];
    return word;
  };
  if (bytes.size() < kSignature || bytes[0] != 0x89 || bytes[1] != 'P') return;
  for (std::size_t at = kSignature; bytes.size() - at >= 12;) {
    const std::size_t length = wordAt(at);
    if (length > bytes.size() - at - 12) return;
    const std::uint32_t sum = sillon::crc32({reinterpret_cast<const char*>(bytes.data()) + at + 4, length + 4});
    for (std::size_t k = 0; k < 4; ++k) bytes[at + 8 + length + k] = static_cast<std::uint8_t>(sum >> (24 - 8 * k));
    at += length + 12;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  mendChecksums(bytes);
  const auto image = sillon::decodeImage(bytes, "picture");
  if (!image) {
    if (image.error().message.empty()) std::abort();
    return 0;
  }
  const sillon::Image& picture = image.value();
  const std::int64_t pixels = static_cast<std::int64_t>(picture.width) * picture.height;
  if (pixels < 1 || pixels > sillon::kMaxReadSamples / 3) std::abort();
  if (picture.channels < 1 || picture.channels > 4) std::abort();
  if (picture.samples.size() != static_cast<std::size_t>(pixels * picture.channels)) std::abort();
  return 0;
}
