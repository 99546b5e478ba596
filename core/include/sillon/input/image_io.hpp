// Encoded pictures in and out. The only place that knows PNG, JPEG, BMP and TGA.
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

inline constexpr int kMaxImageSide = 32768;                   ///< pixels
inline constexpr std::int64_t kMaxImagePixels = 100'000'000;  ///< of those that are made
/// Values of a picture that is read, so that it takes 1.6 GB at most while it is decoded: 133
/// million pixels, or 100 million with transparency.
inline constexpr std::int64_t kMaxReadSamples = 400'000'000;

/// Decodes PNG, JPEG, BMP or TGA. Stored values as they are: no gamma, no colour profile; 16-bit
/// PNGs keep their bits. The EXIF orientation of a JPEG or PNG is applied.
/// \param name  used in messages only.
/// \return InvalidFile for anything empty, foreign, damaged or cut off; TooLarge beyond the limits
/// above.
Result<Image> decodeImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// Tells whether a file begins with the mark of a picture: one that decodeImage reads, less TGA,
/// which has none, or one of another format (GIF, WebP, HEIC, AVIF, TIFF).
/// \param bytes  its first 32 at least.
bool beginsLikePicture(std::span<const std::uint8_t> bytes);

/// 8-bit PNG of an RGB picture.
/// \param rgb  width * height * 3 bytes, row 0 on top.
/// \param comment  kept in the file if not empty: printable ASCII.
/// \param plain  without filters: for small pictures with little of one colour beside another, such
/// as thumbnails, a tenth to a fifth smaller and in two thirds of the time.
/// \return empty if the sizes do not fit together or exceed kMaxImagePixels, or if memory runs out.
std::vector<std::uint8_t> encodePng(int width, int height, std::span<const std::uint8_t> rgb,
                                    std::string_view comment = {}, bool plain = false);

}  // namespace sillon
