// Reads pictures. stb_image decodes them; the checks around it are written here, because stb_image fills the missing
// part of a cut-off file with zeros, ignores checksums, and believes any size that a file claims.
#include "sillon/input/image_io.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "base/checksums.hpp"
#include "base/deflate.hpp"
#include "base/refused.hpp"
#include "input/inflate.hpp"

namespace {

// Limit on an allocation of the decoder [bytes], set from the size that the picture announces; stops zlib bombs.
thread_local std::size_t allocationLimit = 0;

// Memory is zeroed, because the decoder uses Huffman tables that a damaged JPEG never defined.
void* limitedAllocate(std::size_t size) { return size <= allocationLimit ? std::calloc(1, size) : nullptr; }
void* limitedReallocate(void* old, std::size_t size) {
  return size <= allocationLimit ? std::realloc(old, size) : nullptr;
}

}  // namespace

#define STBI_MALLOC(size) limitedAllocate(size)
#define STBI_REALLOC(old, size) limitedReallocate(old, size)
#define STBI_FREE(old) std::free(old)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#if defined(__clang__)
// Damaged JPEG coefficients overflow ints inside stb_image; the only effect is wrong pixels.
#pragma clang attribute push(__attribute__((no_sanitize("undefined"))), apply_to = function)
#endif
#include <stb_image.h>
#if defined(__clang__)
#pragma clang attribute pop
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace sillon {
namespace {

using Bytes = std::span<const std::uint8_t>;

enum class Format { Png, Jpeg, Bmp, Tga, Unknown };

constexpr const char* kFormatNames[] = {"PNG", "JPEG", "BMP", "TGA"};

// Largest number of pixels that one byte can stand for: deflate packs 1032:1 and a pixel may have 1 bit; a JPEG block
// of 64 pixels takes at least one bit of a chroma-subsampled scan; a BMP is not packed; a TGA run of 128 pixels takes 2
// bytes.
constexpr std::int64_t kPixelsPerByte[] = {1032 * 8, 64 * 8 * 16, 8, 128};

// Limit on the scans of a JPEG. Real progressive JPEGs have about 10; each costs a pass over the whole picture.
constexpr int kMaxJpegScans = 100;

std::uint32_t le16(Bytes b, std::size_t at) { return b[at] | static_cast<std::uint32_t>(b[at + 1]) << 8; }
std::uint32_t be16(Bytes b, std::size_t at) { return b[at + 1] | static_cast<std::uint32_t>(b[at]) << 8; }
std::uint32_t le32(Bytes b, std::size_t at) { return le16(b, at) | le16(b, at + 2) << 16; }
std::uint32_t be32(Bytes b, std::size_t at) { return be16(b, at + 2) | be16(b, at) << 16; }

bool startsWith(Bytes bytes, std::string_view magic) {
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char c, std::uint8_t b) { return static_cast<std::uint8_t>(c) == b; });
}

// ---- TGA ----

struct TgaHeader {
  std::uint32_t type = 0;  // 1 palette, 2 colour, 3 grey; + 8 if run-length packed
  std::uint32_t pixelBytes = 0;
  std::uint64_t pixels = 0;
  std::size_t dataAt = 0;
};

// Reads the header of a TGA. The format has no magic number, so a header counts only if all its fields fit together.
bool readTgaHeader(Bytes b, TgaHeader& header) {
  if (b.size() < 18) return false;
  const std::uint32_t hasPalette = b[1], type = b[2], paletteBits = b[7], bits = b[16], descriptor = b[17];
  const std::uint32_t paletteFirst = le16(b, 3), paletteLength = le16(b, 5);
  const std::uint32_t base = type & 7u;
  if (base < 1 || base > 3 || (type & ~11u) != 0 || hasPalette != (base == 1 ? 1u : 0u)) return false;
  if (hasPalette != 0) {
    if (paletteFirst != 0 || paletteLength == 0 || bits != 8) return false;
    if (paletteBits != 15 && paletteBits != 16 && paletteBits != 24 && paletteBits != 32) return false;
  } else if (paletteFirst != 0 || paletteLength != 0 || (paletteBits != 0 && paletteBits != 24)) {
    return false;  // some writers fill in a depth of 24 for a palette that does not exist
  }
  if (base == 2 && bits != 15 && bits != 16 && bits != 24 && bits != 32) return false;
  if (base == 3 && bits != 8 && bits != 16) return false;
  // The descriptor may only name alpha bits that the pixel can hold, and neither interleaving nor right-to-left rows.
  if ((descriptor & 0xd0u) != 0 || (descriptor & 15u) > 8 || (bits == 24 && (descriptor & 15u) != 0)) return false;
  header.type = type;
  header.pixelBytes = (bits + 7) / 8;
  header.pixels = static_cast<std::uint64_t>(le16(b, 12)) * le16(b, 14);
  header.dataAt = 18 + b[0] + paletteLength * ((paletteBits + 7) / 8);
  return header.pixels > 0;
}

constexpr Reason kCutOff("PictureCutOff");

std::optional<Reason> cutOffIf(bool cut) { return cut ? std::optional(kCutOff) : std::nullopt; }

/// Returns what is wrong with a TGA; nothing if it is complete.
std::optional<Reason> tgaDefect(Bytes bytes) {
  TgaHeader header;
  readTgaHeader(bytes, header);
  const std::uint64_t size = bytes.size();
  if ((header.type & 8) == 0) return cutOffIf(header.dataAt + header.pixels * header.pixelBytes > size);
  std::uint64_t at = header.dataAt, pixels = 0;
  while (pixels < header.pixels) {
    if (at >= size) return kCutOff;
    const std::uint64_t run = (bytes[toSize(at)] & 127u) + 1;
    at += 1 + ((bytes[toSize(at)] & 128u) != 0 ? 1 : run) * header.pixelBytes;
    pixels += run;
  }
  return cutOffIf(at > size);
}

// ---- EXIF ----

struct Facts {
  std::optional<Reason> defect;
  int orientation = 1;  // EXIF, 1..8
};

/// Reads the orientation from EXIF tags.
/// \param tiff  the tags, in the TIFF layout that EXIF uses.
/// \return 1..8; 1 if nothing valid is found.
int exifOrientation(Bytes tiff) {
  if (tiff.size() < 8) return 1;
  const bool little = tiff[0] == 'I';
  const auto u16 = [&](std::size_t at) { return little ? le16(tiff, at) : be16(tiff, at); };
  const std::size_t directory = little ? le32(tiff, 4) : be32(tiff, 4);
  if (tiff[0] != tiff[1] || (tiff[0] != 'I' && tiff[0] != 'M') || u16(2) != 42) return 1;
  if (directory > tiff.size() - 2) return 1;
  std::size_t entries = u16(directory);
  for (std::size_t at = directory + 2; entries > 0 && tiff.size() - at >= 12; at += 12, --entries) {
    constexpr std::uint32_t kOrientationTag = 0x0112, kShort = 3;
    if (u16(at) != kOrientationTag || u16(at + 2) != kShort) continue;
    const std::uint32_t orientation = u16(at + 8);
    return orientation >= 1 && orientation <= 8 ? static_cast<int>(orientation) : 1;
  }
  return 1;
}

// ---- PNG ----

std::string_view textOf(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// Checks the chunks of a PNG and their checksums, and finds its orientation.
Facts inspectPng(Bytes bytes) {
  Facts facts;
  std::size_t at = 8;
  while (bytes.size() - at >= 12) {
    const std::size_t length = be32(bytes, at);
    if (length > bytes.size() - at - 12) break;
    const Bytes named = bytes.subspan(at + 4, length + 4);
    const bool critical = (named[0] & 32u) == 0;
    if (critical && crc32(textOf(named)) != be32(bytes, at + 8 + length)) {
      facts.defect = Reason("PictureDamaged");
      return facts;
    }
    if (startsWith(named, "eXIf")) facts.orientation = exifOrientation(named.subspan(4));
    if (startsWith(named, "IEND")) return facts;
    at += length + 12;
  }
  facts.defect = kCutOff;
  return facts;
}

// ---- JPEG ----

/// Checks the Huffman tables of a segment: the decoder would write a table with more than 256 codes past its end.
bool huffmanTablesValid(Bytes segment) {
  while (segment.size() >= 17) {
    std::size_t codes = 0;
    for (std::size_t k = 1; k <= 16; ++k) codes += segment[k];
    if (codes > 256 || segment.size() < 17 + codes) return false;
    segment = segment.subspan(17 + codes);
  }
  return segment.empty();
}

/// Checks the segments of a JPEG, and finds its orientation.
Facts inspectJpeg(Bytes bytes) {
  Facts facts;
  int scans = 0;
  std::size_t at = 2;
  const auto isMarker = [&](std::size_t k) {  // excludes stuffed zeros, fill bytes and restarts inside a scan
    return bytes[k] == 0xff && bytes[k + 1] != 0 && bytes[k + 1] != 0xff &&
           (bytes[k + 1] < 0xd0 || bytes[k + 1] > 0xd7);
  };
  for (;;) {
    while (at + 1 < bytes.size() && !isMarker(at)) ++at;
    if (at + 1 >= bytes.size()) break;
    const std::uint8_t marker = bytes[at + 1];
    at += 2;
    if (marker == 0xd9) {  // end of image
      if (scans == 0) facts.defect = Reason("PictureEmpty");
      return facts;
    }
    if (marker == 0xd8 || marker == 0x01) continue;  // no length follows
    if (bytes.size() - at < 2) break;
    const std::size_t length = be16(bytes, at);
    if (length < 2 || length > bytes.size() - at) break;
    const Bytes segment = bytes.subspan(at + 2, length - 2);
    constexpr std::string_view kExif("Exif\0\0", 6);
    if (marker == 0xe1 && facts.orientation == 1 && startsWith(segment, kExif))
      facts.orientation = exifOrientation(segment.subspan(kExif.size()));
    if (marker == 0xc4 && !huffmanTablesValid(segment)) facts.defect = Reason("PictureDamaged");
    if (marker == 0xda && ++scans > kMaxJpegScans) facts.defect = Reason("PictureScans");
    if (facts.defect) return facts;
    at += length;
  }
  facts.defect = kCutOff;
  return facts;
}

/// Converts stored pixels to 16-bit samples, turned and mirrored so that EXIF orientation `orientation` becomes 1.
/// \param image  size and channels of the picture as it is stored.
Image uprighted(const void* stored, bool deep, int orientation, Image image) {
  const int width = image.width, height = image.height, channels = image.channels;
  const bool swapped = orientation >= 5;
  if (swapped) std::swap(image.width, image.height);
  const bool mirrorX = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool mirrorY = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const auto place = [&](int x, int y) {
    if (swapped) std::swap(x, y);
    const std::ptrdiff_t row = mirrorY ? height - 1 - y : y;
    return (row * width + (mirrorX ? width - 1 - x : x)) * channels;
  };
  const auto* bytes = static_cast<const std::uint8_t*>(stored);
  const auto* pairs = static_cast<const std::uint16_t*>(stored);
  image.samples.reserve(cellCount(width, height) * channels);
  for (int y = 0; y < image.height; ++y) {
    std::ptrdiff_t at = place(0, y);
    const std::ptrdiff_t step = place(1, y) - at;
    for (int x = 0; x < image.width; ++x, at += step) {
      for (int c = 0; c < channels; ++c) {
        image.samples.push_back(deep ? pairs[at + c] : static_cast<std::uint16_t>(bytes[at + c] * 257));
      }
    }
  }
  return image;
}

// ---- BMP ----

/// Returns what is wrong with the header or the length of a BMP; nothing if both are good.
std::optional<Reason> bmpDefect(Bytes bytes) {
  if (bytes.size() < 26) return kCutOff;
  const std::uint64_t offset = le32(bytes, 10);
  const bool oldHeader = le32(bytes, 14) == 12;
  if (!oldHeader && bytes.size() < 54) return kCutOff;
  const std::uint64_t width = oldHeader ? le16(bytes, 18) : le32(bytes, 18);
  const std::uint32_t signedHeight = oldHeader ? le16(bytes, 20) : le32(bytes, 22);
  const std::uint64_t height = !oldHeader && (signedHeight >> 31) != 0 ? 0u - signedHeight : signedHeight;
  const std::uint64_t bits = le16(bytes, oldHeader ? 24 : 28);
  if (width == 0 || height == 0 || bits == 0 || bits > 32) return Reason("PictureHeader");
  const std::uint32_t packing = oldHeader ? 0 : le32(bytes, 30);
  if (packing == 1 || packing == 2) return Reason("PicturePacked");
  const std::uint64_t rowBytes = (width * bits + 7) / 8;
  const std::uint64_t stride = (rowBytes + 3) / 4 * 4;  // the last row may lack its padding
  return cutOffIf(offset + stride * (height - 1) + rowBytes > bytes.size());
}

// ---- all ----

/// Recognises the format of a picture by its first bytes.
Format formatOf(Bytes bytes) {
  TgaHeader tga;
  if (startsWith(bytes, "\x89PNG\r\n\x1a\n")) return Format::Png;
  if (startsWith(bytes, "\xff\xd8\xff")) return Format::Jpeg;
  if (startsWith(bytes, "BM") && bytes.size() >= 18) {
    const std::uint32_t header = le32(bytes, 14);
    if (header == 12 || header == 40 || header == 56 || header == 108 || header == 124) return Format::Bmp;
  }
  return readTgaHeader(bytes, tga) ? Format::Tga : Format::Unknown;
}

/// Formats the first bytes as "47 49 46 38", so that people can tell which kind of file they opened.
std::string firstBytes(Bytes bytes) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (std::size_t k = 0; k < std::min<std::size_t>(bytes.size(), 4); ++k) {
    if (k > 0) text += ' ';
    text += kHex[bytes[k] >> 4];
    text += kHex[bytes[k] & 15u];
  }
  return text;
}

// Kinds of files that people mistake for a picture or a drawing, each with the mark that identifies it.
struct Foreign {
  std::size_t at;
  std::string_view mark;
  const char* kind;
  bool picture = false;
};
constexpr Foreign kForeign[] = {
    {0, "GIF8", "GIF", true},
    {8, "WEBP", "WebP", true},
    {4, "ftyp", "HEIC/AVIF", true},
    {0, std::string_view("II*\0", 4), "TIFF", true},
    {0, std::string_view("MM\0*", 4), "TIFF", true},
    {0, "8BPS", "Photoshop"},
    {0, "%PDF", "PDF"},
    {0, "%!PS", "PostScript"},
    {0, "\x1f\x8b", "GZIP"},
    {0, "PK\x03\x04", "ZIP/3MF"},
    {0, "solid ", "STL"},
    {0, "\xff\xfe", "UTF-16"},
    {0, "\xfe\xff", "UTF-16"},
};

/// Returns the row of a file that is neither picture nor drawing; nothing if it is none of these.
const Foreign* foreignKind(Bytes bytes) {
  static constexpr Foreign kDxf{0, "", "DXF"};
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Foreign& foreign : kForeign) {
    if (text.substr(std::min(foreign.at, text.size())).starts_with(foreign.mark)) return &foreign;
  }
  return text.substr(0, 80).find("SECTION") != std::string_view::npos ? &kDxf : nullptr;
}

Error unreadable(const std::string& name, Format format, Reason reason) {
  return refusedFile(reason, {{"file", name}, {"format", kFormatNames[static_cast<int>(format)]}});
}

Error tooLarge(const std::string& name, double width, double height) {
  return refused(ErrorCode::TooLarge, "PictureTooLarge",
                 {{"file", name},
                  {"width", width},
                  {"height", height},
                  {"side", kMaxImageSide},
                  {"millions", kMaxReadSamples / 3'000'000},
                  {"transparent", kMaxReadSamples / 4'000'000}});
}

using Decoded = std::unique_ptr<void, void (*)(void*)>;

/// Decodes a picture after checking its size against limits and against the length of the file.
Result<Image> decodeChecked(Bytes bytes, const std::string& name, Format format, int orientation) {
  const auto* data = bytes.data();
  const int size = static_cast<int>(bytes.size());

  // For a PNG that is too large, the decoder itself would only report "unknown".
  if (format == Format::Png && size >= 24 && std::max(be32(bytes, 16), be32(bytes, 20)) > kMaxImageSide) {
    return tooLarge(name, be32(bytes, 16), be32(bytes, 20));
  }
  Image image;
  allocationLimit = 1u << 20;
  if (stbi_info_from_memory(data, size, &image.width, &image.height, &image.channels) == 0) {
    return unreadable(name, format, "PictureHeader");
  }
  image.height = std::abs(image.height);  // a BMP whose first row is the top one has a negative height
  const std::int64_t pixels = static_cast<std::int64_t>(image.width) * image.height;
  if (image.width > kMaxImageSide || image.height > kMaxImageSide ||
      pixels * std::max(image.channels, 3) > kMaxReadSamples) {
    return tooLarge(name, image.width, image.height);
  }
  if (pixels / kPixelsPerByte[static_cast<int>(format)] > size) return unreadable(name, format, "PictureCutOff");

  // The largest request that an intact picture makes: 4 channels of 16 bits, doubled once by the unpacker when rows of
  // an interlaced PNG need more bytes than first guessed; a JPEG stores 16-bit coefficients of blocks padded to 32
  // pixels.
  allocationLimit = cellCount(image.width + 64, image.height + 64) * 16 + (1u << 20);
  const bool deep = stbi_is_16_bit_from_memory(data, size) != 0;
  const Decoded decoded(
      deep ? static_cast<void*>(stbi_load_16_from_memory(data, size, &image.width, &image.height, &image.channels, 0))
           : static_cast<void*>(stbi_load_from_memory(data, size, &image.width, &image.height, &image.channels, 0)),
      stbi_image_free);
  if (!decoded) return unreadable(name, format, "PictureDamaged");

  image = uprighted(decoded.get(), deep, orientation, std::move(image));
  // The fourth byte of a TGA pixel has no meaning if the header names no alpha bits.
  if (format == Format::Tga && image.channels == 4 && (bytes[17] & 15u) == 0) {
    for (std::size_t k = 3; k < image.samples.size(); k += 4) image.samples[k] = 65535;
  }
  return image;
}

std::string big(std::uint32_t v) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(v >> shift & 0xff);
  return bytes;
}

/// Assembles a chunk of a PNG: length, name, contents and checksum. \param named  the chunk's name and contents.
std::string chunk(const std::string& named) {
  return big(static_cast<std::uint32_t>(named.size() - 4)) + named + big(crc32(named));
}

/// Packs data in the zlib format (RFC 1950), with its header and Adler-32 checksum.
std::string zlibPacked(std::string_view data) {
  std::uint32_t sum = 1;
  std::uint32_t sums = 0;
  for (std::size_t k = 0; k < data.size(); ++k) {
    sum += static_cast<std::uint8_t>(data[k]);
    sums += sum;
    if (k % 5552 != 5551 && k + 1 != data.size()) continue;  // sums of up to 5552 bytes fit into 32 bits
    sum %= 65521;
    sums %= 65521;
  }
  return "\x78\x01" + deflated(data) + big(sums << 16 | sum);
}

/// Returns the PNG predictor of Paeth: whichever of the neighbours left, above and between them is nearest to left +
/// above - between.
int paeth(int left, int above, int between) {
  const int byLeft = std::abs(above - between);
  const int byAbove = std::abs(left - between);
  const int byBoth = std::abs(left + above - 2 * between);
  const int other = byAbove <= byBoth ? above : between;
  return byLeft <= byAbove && byLeft <= byBoth ? left : other;
}

/// Filters the rows of a PNG; each begins with the number of its filter.
std::string rowsOf(int width, int height, std::span<const std::uint8_t> rgb, bool plain) {
  constexpr std::size_t kPixel = 3;
  const std::size_t size = width * kPixel;
  // Each row begins with one empty pixel, so that the loop has no branches and compilers can vectorise it.
  std::vector<std::uint8_t> above(size + kPixel);
  std::vector<std::uint8_t> row = above;
  std::string rows((size + 1) * height, plain ? '\0' : '\4');
  auto* out = reinterpret_cast<std::uint8_t*>(rows.data());
  for (int y = 0; y < height; ++y, row.swap(above)) {
    std::copy_n(rgb.data() + y * size, size, row.data() + kPixel);
    ++out;
    const std::uint8_t* const r = row.data();
    const std::uint8_t* const a = above.data();
    if (plain) {
      std::copy_n(r + kPixel, size, out);
    } else {
      for (std::size_t x = 0; x < size; ++x) {
        out[x] = static_cast<std::uint8_t>(r[x + kPixel] - paeth(r[x], a[x + kPixel], a[x]));
      }
    }
    out += size;
  }
  return rows;
}

}  // namespace

Result<Image> decodeImage(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.empty()) return refusedFile("FileEmpty", {{"file", name}});
  constexpr std::size_t kMaxBytes = 0x7fffffff;
  if (bytes.size() > kMaxBytes) return inPlace(fileTooLarge(bytes.size(), kMaxBytes), name);

  const Format format = formatOf(bytes);
  Facts facts;
  switch (format) {
    case Format::Png:
      facts = inspectPng(bytes);
      break;
    case Format::Jpeg:
      facts = inspectJpeg(bytes);
      break;
    case Format::Bmp:
      facts.defect = bmpDefect(bytes);
      break;
    case Format::Tga:
      facts.defect = tgaDefect(bytes);
      break;
    case Format::Unknown:
      if (const Foreign* kind = foreignKind(bytes)) {
        return refusedFile("FormatUnread", {{"file", name}, {"kind", kind->kind}});
      }
      return refusedFile("UnknownPicture", {{"file", name}, {"bytes", firstBytes(bytes)}});
  }
  if (facts.defect) return unreadable(name, format, *facts.defect);
  try {
    return decodeChecked(bytes, name, format, facts.orientation);
  } catch (const std::bad_alloc&) {
    return inPlace(refused(ErrorCode::TooLarge, "NeedsMoreMemory"), name);
  }
}

std::vector<std::uint8_t> encodePng(int width, int height, std::span<const std::uint8_t> rgb, std::string_view comment,
                                    bool plain) {
  if (width <= 0 || height <= 0) return {};
  const std::int64_t pixels = static_cast<std::int64_t>(width) * height;
  if (pixels > kMaxImagePixels || static_cast<std::int64_t>(rgb.size()) != pixels * 3) return {};
  try {
    constexpr std::string_view kTrueColour("\x08\x02\0\0\0", 5);
    std::string head = "IHDR" + big(static_cast<std::uint32_t>(width)) + big(static_cast<std::uint32_t>(height));
    head += kTrueColour;
    std::string png = "\x89PNG\r\n\x1a\n" + chunk(head);
    if (!comment.empty()) png += chunk(std::string("tEXtComment\0", 12).append(comment));
    png += chunk("IDAT" + zlibPacked(rowsOf(width, height, rgb, plain))) + chunk("IEND");
    return {png.begin(), png.end()};
  } catch (const std::bad_alloc&) {
    return {};
  }
}

bool beginsLikePicture(std::span<const std::uint8_t> bytes) {
  const Format format = formatOf(bytes);
  if (format != Format::Unknown && format != Format::Tga) return true;  // a TGA has no mark at its beginning
  const Foreign* const kind = foreignKind(bytes);
  return kind != nullptr && kind->picture;
}

std::optional<std::string> inflated(std::string_view data, std::size_t size) {
  constexpr std::size_t kMost = 1U << 30;
  if (data.size() > kMost || size > kMost) return std::nullopt;
  try {
    std::string out(size, '\0');
    const int got = stbi_zlib_decode_noheader_buffer(out.data(), static_cast<int>(size), data.data(),
                                                     static_cast<int>(data.size()));
    if (got != static_cast<int>(size)) return std::nullopt;
    return out;
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

}  // namespace sillon
