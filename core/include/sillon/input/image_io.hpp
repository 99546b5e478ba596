// Reads and writes encoded pictures. This is the only place that knows PNG, JPEG, BMP and TGA.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

inline constexpr int kMaxImageSide = 32768;  ///< longest side of a picture [pixels]
/// Most pixels of a picture that is made
inline constexpr std::int64_t kMaxImagePixels = 100'000'000;
/// Most values of a picture that is read: 133 million pixels, or 100 million with transparency.
/// They limit it to 1.6 GB while it is decoded.
inline constexpr std::int64_t kMaxReadSamples = 400'000'000;

/// Decodes PNG, JPEG, BMP or TGA. Stored values are kept as they are, without gamma or colour
/// profile; 16-bit PNGs keep their bits. The EXIF orientation of a JPEG or PNG is applied.
/// \param name  name of the file, used in messages only.
/// \return InvalidFile for a file that is empty, of another format, damaged or cut off; TooLarge
/// beyond the limits above.
Result<Image> decodeImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// Tells whether a file begins with the mark of a picture. The picture may be one that decodeImage
/// reads, except TGA, which has no mark, or one of another format (GIF, WebP, HEIC, AVIF, TIFF).
/// \param bytes  first bytes of the file, 32 at least.
bool beginsLikePicture(std::span<const std::uint8_t> bytes);

/// Encodes an RGB picture as an 8-bit PNG.
/// \param rgb  width * height * 3 bytes, row 0 on top.
/// \param comment  printable ASCII, kept in the file if not empty.
/// \param plain  leaves out the filters. Small pictures with few areas of one colour, such as
/// thumbnails, become a tenth to a fifth smaller, in two thirds of the time.
/// \return empty if the sizes do not fit together or exceed kMaxImagePixels, or if memory runs out.
std::vector<std::uint8_t> encodePng(int width, int height, std::span<const std::uint8_t> rgb,
                                    std::string_view comment = {}, bool plain = false);

}  // namespace sillon
