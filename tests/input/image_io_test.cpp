#include "sillon/input/image_io.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

using namespace sillon;

namespace {

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& to, const Bytes& more) {
  for (const std::uint8_t byte : more) to.push_back(byte);
}
void append(Bytes& to, std::string_view text) {
  for (const char c : text) to.push_back(static_cast<std::uint8_t>(c));
}
void appendBe32(Bytes& to, std::uint32_t v) {
  for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<std::uint8_t>(v >> shift));
}
void appendLe(Bytes& to, std::uint32_t v, int count) {
  for (int k = 0; k < count; ++k) to.push_back(static_cast<std::uint8_t>(v >> (8 * k)));
}

std::uint32_t crcOf(const std::uint8_t* data, std::size_t size) {
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t k = 0; k < size; ++k) {
    crc ^= data[k];
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

void appendChunk(Bytes& png, std::string_view type, const Bytes& data) {
  appendBe32(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t from = png.size();
  append(png, type);
  append(png, data);
  appendBe32(png, crcOf(&png[from], png.size() - from));
}

/// \param zlib  contents of IDAT. \param tiff  contents of eXIf, if any.
Bytes pngOf(std::uint32_t width, std::uint32_t height, int depth, int colourType, const Bytes& zlib,
            const Bytes& tiff = {}) {
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  appendBe32(header, width);
  appendBe32(header, height);
  append(header, {static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(colourType), 0, 0, 0});
  appendChunk(png, "IHDR", header);
  if (!tiff.empty()) appendChunk(png, "eXIf", tiff);
  appendChunk(png, "IDAT", zlib);
  appendChunk(png, "IEND", {});
  return png;
}

/// One stored block; rows begin with their filter byte.
Bytes zlibStored(const Bytes& rows) {
  Bytes zlib{0x78, 0x01, 0x01};
  appendLe(zlib, static_cast<std::uint32_t>(rows.size()), 2);
  appendLe(zlib, ~static_cast<std::uint32_t>(rows.size()), 2);
  append(zlib, rows);
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : rows) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  appendBe32(zlib, b << 16 | a);
  return zlib;
}

class BitWriter {
 public:
  explicit BitWriter(bool highBitFirst) : highBitFirst_(highBitFirst) {}
  void bits(std::uint32_t value, int count) {  // of a Huffman code: its highest bit first in both formats
    for (int k = count - 1; k >= 0; --k) bit((value >> k) & 1u);
  }
  void bit(std::uint32_t b) {
    if (used_ == 0) bytes.push_back(0);
    bytes.back() = static_cast<std::uint8_t>(bytes.back() | b << (highBitFirst_ ? 7 - used_ : used_));
    used_ = (used_ + 1) % 8;
  }
  void padWithOnes() {
    while (used_ != 0) bit(1);
  }
  Bytes bytes;

 private:
  bool highBitFirst_;
  int used_ = 0;
};

/// Zeros by fixed Huffman codes, 258 of them in 13 bits.
Bytes zlibOfZeros(int repeats) {
  BitWriter out(false);
  out.bit(1);              // final
  out.bit(1), out.bit(0);  // fixed codes
  out.bits(0x30, 8);       // literal 0
  for (int k = 0; k < repeats; ++k) {
    out.bits(0xc5, 8);  // length 258
    out.bits(0, 5);     // distance 1
  }
  out.bits(0, 7);  // end
  Bytes zlib{0x78, 0x01};
  append(zlib, out.bytes);
  appendBe32(zlib, 0);
  return zlib;
}

/// Grey baseline JPEG of flat 8 x 8 blocks. Quantiser 8 and DC only: every pixel of a block is exactly its level.
Bytes jpegOf(int blocksWide, const std::vector<int>& levels, const Bytes& app1 = {}) {
  const int width = 8 * blocksWide, height = 8 * static_cast<int>(levels.size()) / blocksWide;
  Bytes jpeg{0xff, 0xd8};
  if (!app1.empty()) {
    append(jpeg, {0xff, 0xe1, 0, static_cast<std::uint8_t>(app1.size() + 2)});
    append(jpeg, app1);
  }
  append(jpeg, {0xff, 0xdb, 0, 67, 0});
  for (int k = 0; k < 64; ++k) jpeg.push_back(8);
  append(jpeg, {0xff, 0xc0, 0, 11, 8, 0, static_cast<std::uint8_t>(height), 0, static_cast<std::uint8_t>(width), 1, 1,
                0x11, 0});
  append(jpeg, {0xff, 0xc4, 0, 31, 0x00, 0, 0, 0, 12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});  // 12 codes of 4 bits
  for (std::uint8_t k = 0; k < 12; ++k) jpeg.push_back(k);
  append(jpeg, {0xff, 0xc4, 0, 20, 0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});  // "0": end of block
  append(jpeg, {0xff, 0xda, 0, 8, 1, 1, 0x00, 0, 63, 0});
  BitWriter scan(true);
  int before = 128;
  for (const int level : levels) {
    const int change = level - before;
    int category = 0;
    while ((change < 0 ? -change : change) >> category != 0) ++category;
    scan.bits(static_cast<std::uint32_t>(category), 4);
    scan.bits(static_cast<std::uint32_t>(change < 0 ? change - 1 : change), category);
    scan.bit(0);
    before = level;
  }
  scan.padWithOnes();
  for (const std::uint8_t byte : scan.bytes) {
    jpeg.push_back(byte);
    if (byte == 0xff) jpeg.push_back(0);
  }
  append(jpeg, {0xff, 0xd9});
  return jpeg;
}

/// As PNGs have it.
Bytes tiffOf(int orientation, bool little) {
  const auto o = static_cast<std::uint8_t>(orientation);
  if (little) return {'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 0x12, 1, 3, 0, 1, 0, 0, 0, o, 0, 0, 0, 0, 0, 0, 0};
  return {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 1, 0x12, 0, 3, 0, 0, 0, 1, 0, o, 0, 0, 0, 0, 0, 0};
}

/// As JPEGs have it.
Bytes exifOf(int orientation, bool little) {
  Bytes exif;
  append(exif, std::string_view("Exif\0\0", 6));
  append(exif, tiffOf(orientation, little));
  return exif;
}

/// 2 x 2, blue green above red white.
Bytes bmp() {
  Bytes b{'B', 'M'};
  appendLe(b, 70, 4), appendLe(b, 0, 4), appendLe(b, 54, 4), appendLe(b, 40, 4);
  appendLe(b, 2, 4), appendLe(b, 2, 4), appendLe(b, 1, 2), appendLe(b, 24, 2);
  appendLe(b, 0, 4), appendLe(b, 16, 4), appendLe(b, 0, 4), appendLe(b, 0, 4), appendLe(b, 0, 4), appendLe(b, 0, 4);
  append(b, {0, 0, 255, 255, 255, 255, 0, 0});  // bottom row: red, white, padding
  append(b, {255, 0, 0, 0, 255, 0, 0, 0});      // top row: blue, green, padding
  return b;
}

/// The same with the short header of OS/2.
Bytes oldBmp() {
  Bytes b{'B', 'M'};
  appendLe(b, 42, 4), appendLe(b, 0, 4), appendLe(b, 26, 4), appendLe(b, 12, 4);
  appendLe(b, 2, 2), appendLe(b, 2, 2), appendLe(b, 1, 2), appendLe(b, 24, 2);
  const Bytes whole = bmp();
  b.insert(b.end(), whole.begin() + 54, whole.end());
  return b;
}

/// The same with the top row first, which a negative height tells.
Bytes topDownBmp() {
  Bytes b = bmp();
  for (std::size_t k = 0; k < 4; ++k) b[22 + k] = k == 0 ? 0xfe : 0xff;  // -2
  std::swap_ranges(b.begin() + 54, b.begin() + 62, b.begin() + 62);
  return b;
}

/// 3 x 2 grey, top row first: 10 20 30 above 40 40 40.
Bytes tga(bool packed) {
  Bytes b{0, 0, static_cast<std::uint8_t>(packed ? 11 : 3), 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 2, 0, 8, 0x20};
  append(b, packed ? Bytes{0x02, 10, 20, 30, 0x82, 40} : Bytes{10, 20, 30, 40, 40, 40});
  return b;
}

std::vector<int> eighths(const Image& image) {  // 8-bit values of one channel at the centres of 8 x 8 blocks
  std::vector<int> found;
  for (int y = 4; y < image.height; y += 8) {
    for (int x = 4; x < image.width; x += 8) found.push_back(image.at(x, y, 0) / 257);
  }
  return found;
}

bool says(const Result<Image>& result, std::string_view word) {
  return !result.ok() && result.error().message.find(word) != std::string::npos;
}

std::uint32_t hashed(std::uint32_t k) {
  k = (k ^ (k >> 16)) * 0x7feb352du;
  k = (k ^ (k >> 15)) * 0x846ca68bu;
  return k ^ (k >> 16);
}

}  // namespace

TEST_CASE("the fourth byte of a TGA is alpha only where its header says so") {
  for (const int alphaBits : {0, 8}) {
    Bytes file(18, 0);
    file[2] = 2;  // colour
    file[12] = file[14] = 1;
    file[16] = 32;
    file[17] = static_cast<std::uint8_t>(0x20 | alphaBits);
    append(file, {10, 20, 30, 0});
    const auto image = decodeImage(file, "tga");
    REQUIRE(image.ok());
    REQUIRE(image.value().channels == 4);
    CHECK(image.value().samples == std::vector<std::uint16_t>{30 * 257, 20 * 257, 10 * 257,
                                                              static_cast<std::uint16_t>(alphaBits == 0 ? 65535 : 0)});
  }
}

TEST_CASE("pictures are known by how they begin, readable or not") {
  const auto begins = [](std::string_view text) {
    return beginsLikePicture({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  for (const std::string_view text : {std::string_view("\x89PNG\r\n\x1a\n"), std::string_view("\xff\xd8\xff\xe0"),
                                      std::string_view("GIF89a"), std::string_view("RIFF....WEBPVP8 ")}) {
    CHECK(begins(text));
  }
  for (const std::string_view text : {"", "{\"sillon\": 1}", "<svg", "%PDF-1.4", "solid x", "GI"})
    CHECK_FALSE(begins(text));
}

TEST_CASE("a picture that was encoded decodes to the same pixels") {
  const int width = 37, height = 21;
  Bytes rgb;
  for (std::uint32_t k = 0; k < 37 * 21 * 3; ++k) rgb.push_back(static_cast<std::uint8_t>(hashed(k)));
  for (const bool plain : {false, true}) {
    CAPTURE(plain);
    const auto decoded = decodeImage(encodePng(width, height, rgb, "a comment", plain), "it");
    REQUIRE(decoded.ok());
    const Image& image = decoded.value();
    CHECK(image.width == width);
    CHECK(image.height == height);
    REQUIRE(image.channels == 3);
    REQUIRE(image.samples.size() == rgb.size());
    for (std::size_t k = 0; k < rgb.size(); ++k) REQUIRE(image.samples[k] == rgb[k] * 257);
  }
}

TEST_CASE("encoding with sizes that do not fit together gives nothing") {
  const Bytes rgb(12);
  CHECK_FALSE(encodePng(2, 2, rgb).empty());
  CHECK(encodePng(2, 3, rgb).empty());
  CHECK(encodePng(0, 2, rgb).empty());
  CHECK(encodePng(-2, -2, rgb).empty());
  CHECK(encodePng(1 << 30, 1 << 30, rgb).empty());
}

TEST_CASE("a PNG of 16 bits keeps all of them, one of 8 bits is widened by 257") {
  const auto deep = decodeImage(pngOf(2, 2, 16, 0, zlibStored({0, 0x12, 0x34, 0xff, 0xff, 0, 0, 0, 0, 1})), "deep");
  REQUIRE(deep.ok());
  CHECK(deep.value().channels == 1);
  CHECK(deep.value().samples == std::vector<std::uint16_t>{0x1234, 0xffff, 0, 1});

  const auto shallow = decodeImage(pngOf(3, 1, 8, 0, zlibStored({0, 0, 127, 255})), "shallow");
  REQUIRE(shallow.ok());
  CHECK(shallow.value().samples == std::vector<std::uint16_t>{0, 127 * 257, 65535});

  const auto bits = decodeImage(pngOf(8, 1, 1, 0, zlibStored({0, 0b10100000})), "bits");
  REQUIRE(bits.ok());
  CHECK(bits.value().samples == std::vector<std::uint16_t>{65535, 0, 65535, 0, 0, 0, 0, 0});
}

TEST_CASE("alpha is kept as a channel and changes no colour") {
  const auto grey = decodeImage(pngOf(1, 1, 8, 4, zlibStored({0, 200, 0})), "grey alpha");
  REQUIRE(grey.ok());
  CHECK(grey.value().channels == 2);
  CHECK(grey.value().samples == std::vector<std::uint16_t>{200 * 257, 0});
  const auto colour = decodeImage(pngOf(1, 1, 16, 6, zlibStored({0, 1, 2, 3, 4, 5, 6, 7, 8})), "colour alpha");
  REQUIRE(colour.ok());
  CHECK(colour.value().channels == 4);
  CHECK(colour.value().samples == std::vector<std::uint16_t>{0x102, 0x304, 0x506, 0x708});
}

TEST_CASE("BMP and TGA are read with their first row on top") {
  const auto fromBmp = decodeImage(bmp(), "bmp");
  REQUIRE(fromBmp.ok());
  CHECK(fromBmp.value().channels == 3);
  const std::uint16_t f = 65535;
  CHECK(fromBmp.value().samples == std::vector<std::uint16_t>{0, 0, f, 0, f, 0, f, 0, 0, f, f, f});
  CHECK(decodeImage(oldBmp(), "bmp").value().samples == fromBmp.value().samples);
  const auto fromTopDown = decodeImage(topDownBmp(), "bmp");
  REQUIRE(fromTopDown.ok());
  CHECK(fromTopDown.value().height == 2);
  CHECK(fromTopDown.value().samples == fromBmp.value().samples);
  for (const bool packed : {false, true}) {
    CAPTURE(packed);
    const auto fromTga = decodeImage(tga(packed), "tga");
    REQUIRE(fromTga.ok());
    CHECK(fromTga.value().width == 3);
    CHECK(fromTga.value().samples ==
          std::vector<std::uint16_t>{10 * 257, 20 * 257, 30 * 257, 40 * 257, 40 * 257, 40 * 257});
  }
}

TEST_CASE("JPEGs and PNGs are turned by each of the 8 EXIF orientations, in both byte orders") {
  // Stored:  A B     What people see, row by row, for orientation 1..8:
  //          C D
  //          E F
  const int a = 10, b = 60, c = 100, d = 140, e = 190, f = 240;
  const std::array<std::vector<int>, 8> seen{{{a, b, c, d, e, f},
                                              {b, a, d, c, f, e},
                                              {f, e, d, c, b, a},
                                              {e, f, c, d, a, b},
                                              {a, c, e, b, d, f},
                                              {e, c, a, f, d, b},
                                              {f, d, b, e, c, a},
                                              {b, d, f, a, c, e}}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const bool little : {false, true}) {
      CAPTURE(orientation);
      CAPTURE(little);
      const auto decoded = decodeImage(jpegOf(2, {a, b, c, d, e, f}, exifOf(orientation, little)), "jpeg");
      REQUIRE(decoded.ok());
      CHECK(decoded.value().width == (orientation >= 5 ? 24 : 16));
      CHECK(decoded.value().height == (orientation >= 5 ? 16 : 24));
      const std::vector<int>& expected = seen[orientation - 1];
      CHECK(eighths(decoded.value()) == expected);

      const Bytes rows = zlibStored({0, a, b, 0, c, d, 0, e, f});
      const auto small = decodeImage(pngOf(2, 3, 8, 0, rows, tiffOf(orientation, little)), "png");
      REQUIRE(small.ok());
      CHECK(small.value().width == (orientation >= 5 ? 3 : 2));
      std::vector<int> levels;
      for (const std::uint16_t sample : small.value().samples) levels.push_back(sample / 257);
      CHECK(levels == expected);
    }
  }
}

TEST_CASE("an EXIF block without a valid orientation changes nothing") {
  const std::vector<int> levels{10, 200};
  Bytes farDirectory = exifOf(6, true);
  farDirectory[13] = 0x7f;
  Bytes manyEntries = exifOf(6, true);
  manyEntries[14] = manyEntries[15] = 0xff;
  manyEntries[16] = 0;  // no longer the orientation tag
  for (const Bytes& exif : {exifOf(0, true), exifOf(9, false), farDirectory, manyEntries, Bytes{'E', 'x', 'i', 'f'}}) {
    const auto decoded = decodeImage(jpegOf(2, levels, exif), "jpeg");
    REQUIRE(decoded.ok());
    CHECK(eighths(decoded.value()) == levels);
  }
}

TEST_CASE("what is no picture is named with its first bytes and the formats that can be read") {
  CHECK(says(decodeImage({}, "a.png"), "a.png is empty"));
  const auto refused = decodeImage(Bytes{'h', 'e', 'l', 'l', 'o'}, "a.txt");
  CHECK(says(refused, "68 65 6c 6c"));
  CHECK(says(refused, "PNG, JPEG, BMP and TGA"));
  CHECK(refused.error().code == ErrorCode::InvalidFile);
  CHECK(says(decodeImage(Bytes{'B'}, "short"), "42"));
}

TEST_CASE("files of other programs are called by their names") {
  const auto kind = [](std::string_view text) {
    const std::string message = decodeImage(Bytes(text.begin(), text.end()), "a").error().message;
    CHECK(message.ends_with("; pictures must be PNG, JPEG, BMP or TGA, and drawings plain SVG in UTF-8"));
    return message.substr(0, message.find(';'));
  };
  CHECK(kind("GIF89a") == "a is a GIF file");
  CHECK(kind(std::string_view("RIFF\x10\0\0\0WEBPVP8 ", 16)) == "a is a WebP file");
  CHECK(kind(std::string_view("\0\0\0\x18"
                              "ftypheic",
                              12)) == "a is a HEIC/AVIF file");
  CHECK(kind("%PDF-1.4") == "a is a PDF file");
  CHECK(kind("0\nSECTION\n2\nHEADER\n") == "a is a DXF file");
  CHECK(kind("  0\r\nSECTION\r\n") == "a is a DXF file");
  CHECK(kind("solid cube\n") == "a is a STL file");
  CHECK(kind(std::string_view("\xff\xfe<\0s\0", 6)) == "a is a UTF-16 file");
  CHECK(kind(std::string_view("\xfe\xff\0<\0s", 6)) == "a is a UTF-16 file");
  CHECK(kind("\x1f\x8b\x08") == "a is a GZIP file");
}

TEST_CASE("random bytes are never taken for a picture") {
  for (std::uint32_t seed = 0; seed < 20000; ++seed) {
    Bytes noise;
    for (std::uint32_t k = 0; k < 60; ++k) noise.push_back(static_cast<std::uint8_t>(hashed(seed * 64 + k)));
    noise[2] = static_cast<std::uint8_t>(1 + seed % 3);  // helps it towards a TGA
    noise[1] = 0;
    REQUIRE_FALSE(decodeImage(noise, "noise").ok());
  }
}

TEST_CASE("every truncation of every format is an error, not a partly filled picture") {
  Bytes unpaddedBmp = bmp();
  unpaddedBmp.resize(unpaddedBmp.size() - 2);
  CHECK(decodeImage(unpaddedBmp, "padding of the last row").ok());
  const std::vector<Bytes> files{pngOf(2, 2, 8, 0, zlibStored({0, 1, 2, 0, 3, 4})), jpegOf(2, {10, 200, 30, 90}),
                                 unpaddedBmp, tga(false), tga(true)};
  for (const Bytes& file : files) {
    REQUIRE(decodeImage(file, "whole").ok());
    for (std::size_t size = 0; size < file.size(); ++size) {
      CAPTURE(size);
      CHECK_FALSE(decodeImage(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)), "cut").ok());
    }
  }
}

TEST_CASE("a flipped bit in a PNG is found by its checksum") {
  const Bytes png = pngOf(2, 2, 8, 0, zlibStored({0, 1, 2, 0, 3, 4}));
  for (std::size_t k = 0; k < png.size(); ++k) {
    CAPTURE(k);
    Bytes damaged = png;
    damaged[k] ^= 1;
    CHECK_FALSE(decodeImage(damaged, "damaged").ok());
  }
}

TEST_CASE("gigantic dimensions are refused before anything is decoded") {
  const Bytes little = zlibStored({0, 1});
  const auto wide = decodeImage(pngOf(40000, 1, 8, 0, little), "wide");
  CHECK(says(wide, "40000 x 1"));
  CHECK(wide.error().code == ErrorCode::TooLarge);
  CHECK(says(decodeImage(pngOf(32768, 32768, 8, 0, little), "large"), "133 million"));
  CHECK(says(decodeImage(pngOf(12000, 9000, 8, 6, little), "large"), "100 million with transparency"));
  CHECK(says(decodeImage(pngOf(12000, 9000, 8, 2, little), "phone"), "cut off"));  // its size would do
  CHECK(decodeImage(pngOf(0x7fffffff, 0x7fffffff, 8, 0, little), "endless").error().code == ErrorCode::TooLarge);
  CHECK_FALSE(decodeImage(pngOf(0, 5, 8, 0, little), "nothing").ok());
}

TEST_CASE("a picture of 108 million pixels, as phones make them, is read") {
  constexpr int kWidth = 12000, kHeight = 9000, kRun = 128;  // grey, of packets of 128 pixels
  Bytes tga{0, 0, 11, 0, 0, 0, 0, 0, 0, 0, 0, 0, kWidth & 255, kWidth >> 8, kHeight & 255, kHeight >> 8, 8, 32};
  for (int k = 0; k < kWidth * kHeight / kRun; ++k) append(tga, {255, static_cast<std::uint8_t>(k)});
  const auto phone = decodeImage(tga, "phone");
  REQUIRE_MESSAGE(phone.ok(), phone.error().message);
  CHECK(phone.value().width == kWidth);
  CHECK(phone.value().samples.size() == std::size_t{kWidth} * kHeight);
  CHECK(phone.value().at(kRun, 0, 0) == 257);
}

TEST_CASE("a file too small for its dimensions is refused before memory is taken for them") {
  CHECK(says(decodeImage(pngOf(10000, 10000, 16, 6, zlibStored({0, 1})), "hollow"), "cut off"));
  Bytes packed = tga(true);
  packed[13] = packed[15] = 0x40;  // 16387 x 16386
  CHECK_FALSE(decodeImage(packed, "hollow tga").ok());
}

TEST_CASE("a BMP packed by run lengths is refused as such, not as cut off") {
  Bytes packed = bmp();
  packed[28] = 8;  // bits
  packed[30] = 1;
  packed.resize(64);
  const auto refused = decodeImage(packed, "rle.bmp");
  CHECK(says(refused, "it is packed"));
  CHECK(says(refused, "save it without compression"));
}

TEST_CASE("a PNG that unpacks to far more than its pixels is refused") {
  REQUIRE(decodeImage(pngOf(257, 1, 8, 0, zlibOfZeros(1)), "honest").ok());
  CHECK_FALSE(decodeImage(pngOf(1, 1, 8, 0, zlibOfZeros(100000)), "bomb").ok());
}

TEST_CASE("a JPEG with hundreds of scans or impossible tables is refused") {
  const Bytes jpeg = jpegOf(1, {90});
  Bytes scans(jpeg.begin(), jpeg.end() - 2);
  for (int k = 0; k < 300; ++k) append(scans, {0xff, 0xda, 0, 8, 1, 1, 0x00, 0, 63, 0});
  append(scans, {0xff, 0xd9});
  CHECK(says(decodeImage(scans, "scans"), "100 scans"));
  Bytes table = jpeg;
  const std::size_t dcCounts = 2 + 69 + 13 + 5;  // after start, quantiser, frame, and the head of the DC table
  table[dcCounts] = table[dcCounts + 1] = 255;
  CHECK(says(decodeImage(table, "table"), "it is damaged"));
}

TEST_CASE("damaged files of every format end in a picture or an error") {
  const std::vector<Bytes> files{pngOf(2, 2, 16, 2, zlibStored({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12,
                                                                1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})),
                                 jpegOf(2, {10, 200, 30, 90}, exifOf(6, true)), bmp(), tga(false), tga(true)};
  int pictures = 0;
  for (std::size_t which = 0; which < files.size(); ++which) {
    for (std::uint32_t seed = 0; seed < 3000; ++seed) {
      Bytes file = files[which];
      for (std::uint32_t flip = 0; flip <= seed % 4; ++flip) {
        const std::uint32_t random = hashed(seed * 8 + flip + static_cast<std::uint32_t>(which) * 100000);
        file[random % file.size()] = static_cast<std::uint8_t>(random >> 24);
      }
      if (which == 0) {  // valid checksums lead the damage past the first check
        for (std::size_t at = 8; at + 12 <= file.size();) {
          const std::size_t length = static_cast<std::size_t>(file[at + 2]) << 8 | file[at + 3];
          if (at + 12 + length > file.size()) break;
          Bytes crc;
          appendBe32(crc, crcOf(&file[at + 4], length + 4));
          std::copy(crc.begin(), crc.end(), file.begin() + static_cast<std::ptrdiff_t>(at + 8 + length));
          at += 12 + length;
        }
      }
      const auto decoded = decodeImage(file, "damaged");
      if (decoded.ok()) {
        ++pictures;
        const Image& image = decoded.value();
        REQUIRE(image.samples.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                            static_cast<std::size_t>(image.channels));
      } else {
        REQUIRE_FALSE(decoded.error().message.empty());
      }
    }
  }
  CHECK(pictures > 100);
}
