// Unpacks web fonts: https://www.w3.org/TR/WOFF/ and https://www.w3.org/TR/WOFF2/. Engines in browsers use
// wasm/src/text/unpack.ts instead.
#include <brotli/decode.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "input/inflate.hpp"
#include "text/unpack_font.hpp"

namespace sillon {
namespace {

constexpr std::size_t kMostFontBytes = std::size_t{30} << 20;  // same limit as in the JavaScript library woff2

/// Reads big-endian numbers. Beyond the end all are 0, and whole() becomes false.
class Bytes {
 public:
  explicit Bytes(std::string_view data) : data_(data) {}

  std::uint32_t number(int bytes) {
    std::uint32_t value = 0;
    for (const char byte : take(bytes)) value = value << 8 | static_cast<unsigned char>(byte);
    return value;
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t word() { return static_cast<std::uint16_t>(number(2)); }

  std::string_view take(std::size_t size) {
    if (size > data_.size() - at_) {
      whole_ = false;
      at_ = data_.size();
      return {};
    }
    at_ += size;
    return data_.substr(at_ - size, size);
  }

  /// Reads a UIntBase128.
  std::uint32_t length() {
    std::uint32_t value = 0;
    for (int k = 0; k < 5; ++k) {
      const std::uint8_t next = byte();
      if ((k == 0 && next == 0x80) || value >> 25 != 0) break;
      value = value << 7 | (next & 0x7FU);
      if ((next & 0x80U) == 0) return value;
    }
    whole_ = false;
    return 0;
  }

  /// Reads a 255UInt16.
  std::uint16_t count() {
    const std::uint8_t code = byte();
    if (code == 253) return word();
    if (code == 254) return static_cast<std::uint16_t>(2 * 253 + byte());
    if (code == 255) return static_cast<std::uint16_t>(253 + byte());
    return code;
  }

  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] std::size_t left() const { return data_.size() - at_; }

 private:
  std::string_view data_;
  std::size_t at_ = 0;
  bool whole_ = true;
};

void put(std::string& out, int bytes, std::uint32_t value) {
  for (int k = bytes - 1; k >= 0; --k) out += static_cast<char>(value >> (8 * k) & 0xFFU);
}

struct FontTable {
  std::string tag;
  std::string_view packed;
  std::size_t size = 0;  ///< size of the unpacked data, or of the transformed data in `packed`
  bool transformed = false;
  std::string data;
};

/// Assembles a font file from tables. Checksums and search fields stay 0, because nothing here reads them.
std::optional<std::string> fontOf(std::uint32_t flavor, const std::vector<const FontTable*>& tables) {
  std::string head, body;
  put(head, 4, flavor);
  put(head, 2, static_cast<std::uint32_t>(tables.size()));
  head.append(6, '\0');
  const std::size_t begin = head.size() + 16 * tables.size();
  for (const FontTable* table : tables) {
    head += table->tag;
    put(head, 4, 0);
    put(head, 4, static_cast<std::uint32_t>(begin + body.size()));
    put(head, 4, static_cast<std::uint32_t>(table->data.size()));
    body += table->data;
    body.append((4 - body.size() % 4) % 4, '\0');
    if (body.size() > kMostFontBytes) return std::nullopt;
  }
  return head + body;
}

/// Unpacks a WOFF.
std::optional<std::string> fromZlib(std::string_view file) {
  Bytes head(file);
  head.take(4);
  const std::uint32_t flavor = head.number(4);
  head.take(4);
  std::vector<FontTable> tables(head.word());
  head.take(30);
  std::size_t size = 0;
  for (FontTable& table : tables) {
    table.tag = head.take(4);
    const std::size_t at = head.number(4), packed = head.number(4);
    table.size = head.number(4);
    head.take(4);
    size += table.size;
    if (!head.whole() || size > kMostFontBytes || at > file.size() || packed > file.size() - at) return std::nullopt;
    table.packed = file.substr(at, packed);
  }
  constexpr std::size_t kHeader = 2;  // bytes of zlib's header
  for (FontTable& table : tables) {
    if (table.packed.size() == table.size) {
      table.data = table.packed;
      continue;
    }
    if (table.packed.size() < kHeader) return std::nullopt;
    std::optional<std::string> data = inflated(table.packed.substr(kHeader), table.size);
    if (!data) return std::nullopt;
    table.data = std::move(*data);
  }
  std::vector<const FontTable*> all;
  for (const FontTable& table : tables) all.push_back(&table);
  return fontOf(flavor, all);
}

/// Tags in the order of their numbers in WOFF2.
constexpr std::string_view kTags =
    "cmapheadhheahmtxmaxpnameOS/2postcvt fpgmglyflocaprepCFF VORGEBDTEBLCgasphdmxkernLTSHPCLTVDMXvheavmtxBASEGDEFGPOS"
    "GSUBEBSCJSTFMATHCBDTCBLCCOLRCPALSVG sbixacntavarbdatblocbslncvarfdscfeatfmtxfvargvarhstyjustlcarmortmorxopbdprop"
    "trakZapfSilfGlatGlocFeatSill";

/// Offset of a point from the one before, as WOFF2 stores it.
struct Step {
  int dx = 0;
  int dy = 0;
};

/// Decodes an offset between points, whose flag tells the number of bytes (WOFF2, sec. 5.2).
Step nextStep(unsigned flag, Bytes& data) {
  const auto toward = [](unsigned sign, unsigned size) {
    return (sign & 1U) != 0 ? static_cast<int>(size) : -static_cast<int>(size);
  };
  const unsigned a = data.byte();
  if (flag < 10) return {0, toward(flag, ((flag & 14U) << 7) + a)};
  if (flag < 20) return {toward(flag, (((flag - 10) & 14U) << 7) + a), 0};
  if (flag < 84) {
    const unsigned high = flag - 20;
    return {toward(flag, 1 + (high & 0x30U) + (a >> 4)), toward(flag >> 1, 1 + ((high & 0x0CU) << 2) + (a & 15U))};
  }
  const unsigned b = data.byte();
  if (flag < 120) {
    const unsigned high = flag - 84;
    return {toward(flag, 1 + (high / 12 << 8) + a), toward(flag >> 1, 1 + (high % 12 >> 2 << 8) + b)};
  }
  const unsigned c = data.byte();
  if (flag < 124) return {toward(flag, (a << 4) + (b >> 4)), toward(flag >> 1, ((b & 15U) << 8) + c)};
  return {toward(flag, (a << 8) + b), toward(flag >> 1, (c << 8) + data.byte())};
}

/// Restores the tables of outlines, which WOFF2 splits into streams of similar numbers. Instructions for small screens
/// are left out.
class Outlines {
 public:
  /// \return false if the data are damaged.
  bool read(std::string_view transformed) {
    Bytes head(transformed);
    head.take(2);
    const bool overlaps = (head.word() & 1U) != 0;
    const std::size_t glyphs = head.word();
    head.take(2);
    std::array<std::uint32_t, 7> sizes{};
    for (std::uint32_t& size : sizes) size = head.number(4);
    std::array<std::string_view, 7> streams;
    for (std::size_t k = 0; k < streams.size(); ++k) streams[k] = head.take(sizes[k]);
    contours_ = Bytes(streams[0]);
    points_ = Bytes(streams[1]);
    flags_ = Bytes(streams[2]);
    steps_ = Bytes(streams[3]);
    parts_ = Bytes(streams[4]);
    boxes_ = Bytes(streams[5]);
    const std::string_view boxed = boxes_.take((glyphs + 31) / 32 * 4);
    const std::string_view overlapped = overlaps ? head.take((glyphs + 7) / 8) : std::string_view();
    if (!head.whole() || !boxes_.whole()) return false;
    const auto has = [](std::string_view bits, std::size_t k) {
      return k / 8 < bits.size() && (static_cast<unsigned char>(bits[k / 8]) >> (7 - k % 8) & 1U) != 0;
    };
    for (std::size_t k = 0; k < glyphs; ++k) {
      put(loca, 4, static_cast<std::uint32_t>(glyf.size()));
      if (!addGlyph(has(boxed, k), has(overlapped, k)) || glyf.size() > kMostFontBytes) return false;
    }
    put(loca, 4, static_cast<std::uint32_t>(glyf.size()));
    return true;
  }

  std::string glyf, loca;
  std::vector<std::uint16_t> left;  ///< smallest x of each glyph

 private:
  /// Appends a glyph to `glyf`. Returns false if the data are damaged.
  bool addGlyph(bool boxed, bool overlapped) {
    const std::uint16_t contours = contours_.word();
    left.push_back(0);
    if (contours == 0) return contours_.whole() && !boxed;
    std::string box(boxed ? boxes_.take(8) : std::string_view());
    std::string body;
    const bool whole = contours == 0xFFFF ? boxed && addParts(body) : addPoints(contours, overlapped, box, body);
    if (!whole || !contours_.whole() || !boxes_.whole()) return false;
    left.back() = Bytes(box).word();
    put(glyf, 2, contours);
    glyf += box + body;
    glyf.append((4 - glyf.size() % 4) % 4, '\0');
    return true;
  }

  /// Adds a glyph made of other glyphs.
  bool addParts(std::string& body) {
    enum : unsigned { Words = 1, Scale = 8, More = 0x20, Scales = 0x40, Matrix = 0x80, Instructions = 0x100 };
    unsigned flags = More;
    bool instructs = false;
    while ((flags & More) != 0) {
      flags = parts_.word();
      std::size_t size = (flags & Words) != 0 ? 6 : 4;
      if ((flags & Scale) != 0)
        size += 2;
      else if ((flags & Scales) != 0)
        size += 4;
      else if ((flags & Matrix) != 0)
        size += 8;
      instructs = instructs || (flags & Instructions) != 0;
      put(body, 2, flags & ~static_cast<unsigned>(Instructions));
      body += parts_.take(size);
      if (!parts_.whole()) return false;
    }
    if (instructs) steps_.count();  // skips the number of bytes of instructions
    return steps_.whole();
  }

  /// Adds the points of a simple glyph, and computes its box unless it is given.
  bool addPoints(std::size_t contours, bool overlapped, std::string& box, std::string& body) {
    std::size_t points = 0;
    for (std::size_t k = 0; k < contours; ++k) {
      points += points_.count();
      if (!points_.whole() || points == 0 || points > flags_.left()) return false;
      put(body, 2, static_cast<std::uint32_t>(points - 1));
    }
    put(body, 2, 0);
    std::string xs, ys;
    int x = 0, y = 0;
    constexpr int kFar = std::numeric_limits<int>::max();
    int least[2] = {kFar, kFar}, most[2] = {-kFar, -kFar};
    for (std::size_t k = 0; k < points; ++k) {
      const unsigned flag = flags_.byte();
      const Step step = nextStep(flag & 0x7FU, steps_);
      x += step.dx;
      y += step.dy;
      least[0] = std::min(least[0], x);
      least[1] = std::min(least[1], y);
      most[0] = std::max(most[0], x);
      most[1] = std::max(most[1], y);
      const unsigned onCurve = flag >> 7 == 0 ? 1 : 0;
      put(body, 1, onCurve | (overlapped && k == 0 ? 0x40U : 0));
      put(xs, 2, static_cast<std::uint32_t>(step.dx));
      put(ys, 2, static_cast<std::uint32_t>(step.dy));
    }
    steps_.count();  // skips the number of bytes of instructions
    body += xs + ys;
    if (box.empty()) {
      for (const int edge : {least[0], least[1], most[0], most[1]}) put(box, 2, static_cast<std::uint32_t>(edge));
    }
    return steps_.whole();
  }

  Bytes contours_{""}, points_{""}, flags_{""}, steps_{""}, parts_{""}, boxes_{""};
};

/// Restores widths, and left edges where they are not those of the outlines.
std::optional<std::string> widthsOf(std::string_view transformed, std::size_t wide, const Outlines& outlines) {
  Bytes data(transformed);
  const unsigned flags = data.byte();
  const std::size_t glyphs = outlines.left.size();
  if (wide > glyphs || wide == 0) return std::nullopt;
  std::vector<std::uint16_t> widths(wide), left = outlines.left;
  for (std::uint16_t& width : widths) width = data.word();
  for (std::size_t k = 0; k < glyphs; ++k) {
    if ((flags >> (k < wide ? 0 : 1) & 1U) == 0) left[k] = data.word();
  }
  if (!data.whole()) return std::nullopt;
  std::string out;
  for (std::size_t k = 0; k < glyphs; ++k) {
    if (k < wide) put(out, 2, widths[k]);
    put(out, 2, left[k]);
  }
  return out;
}

FontTable* tableOf(const std::vector<FontTable*>& tables, std::string_view tag) {
  const auto found =
      std::find_if(tables.begin(), tables.end(), [&](const FontTable* table) { return table->tag == tag; });
  return found == tables.end() ? nullptr : *found;
}

/// Restores the tables that WOFF2 transforms.
bool restore(const std::vector<FontTable*>& tables) {
  constexpr std::size_t kLocaFormat = 50, kWide = 34;  // offsets in `head` and in `hhea`
  for (FontTable* table : tables) {
    if (!table->transformed) table->data = table->packed;
  }
  FontTable *const glyf = tableOf(tables, "glyf"), *const loca = tableOf(tables, "loca");
  Outlines outlines;
  if (glyf != nullptr && glyf->transformed) {
    FontTable* const head = tableOf(tables, "head");
    if (loca == nullptr || head == nullptr || head->data.size() < kLocaFormat + 2) return false;
    if (!outlines.read(glyf->packed)) return false;
    glyf->data = outlines.glyf;
    loca->data = outlines.loca;
    head->data[kLocaFormat + 1] = 1;  // long offsets
  }
  FontTable* const widths = tableOf(tables, "hmtx");
  if (widths == nullptr || !widths->transformed) return true;
  const FontTable* const hhea = tableOf(tables, "hhea");
  if (hhea == nullptr || hhea->data.size() < kWide + 2) return false;
  std::optional<std::string> restored =
      widthsOf(widths->packed, Bytes(std::string_view(hhea->data).substr(kWide)).word(), outlines);
  if (restored) widths->data = std::move(*restored);
  return restored.has_value();
}

/// Unpacks a WOFF2; of a collection its first font.
std::optional<std::string> fromBrotli(std::string_view file) {
  constexpr std::uint32_t kCollection = 0x74746366;  // ttcf
  Bytes head(file);
  head.take(4);
  std::uint32_t flavor = head.number(4);
  head.take(4);
  std::vector<FontTable> tables(head.word());
  head.take(6);
  const std::size_t packed = head.number(4);
  head.take(24);
  std::size_t size = 0;
  for (FontTable& table : tables) {
    const unsigned flags = head.byte(), known = flags & 63U, version = flags >> 6;
    table.tag = known == 63 ? head.take(4) : kTags.substr(4 * known, 4);
    const bool outline = table.tag == "glyf" || table.tag == "loca";
    table.transformed = version != (outline ? 3U : 0U);
    table.size = head.length();
    if (table.transformed) table.size = head.length();
    size += table.size;
    if (!head.whole() || size > kMostFontBytes) return std::nullopt;
  }
  std::vector<FontTable*> own;
  if (flavor == kCollection) {
    head.take(4);  // version of the collection
    const std::size_t fonts = head.count();
    for (std::size_t font = 0; font < fonts; ++font) {
      const std::size_t count = head.count();
      const std::uint32_t kind = head.number(4);
      if (font == 0) flavor = kind;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t index = head.count();
        if (!head.whole() || index >= tables.size()) return std::nullopt;
        if (font == 0) own.push_back(&tables[index]);
      }
      if (!head.whole()) return std::nullopt;
    }
  } else {
    for (FontTable& table : tables) own.push_back(&table);
  }
  const std::string_view stream = head.take(packed);
  std::string data(size, '\0');
  std::size_t unpacked = size;
  const BrotliDecoderResult result =
      BrotliDecoderDecompress(stream.size(), reinterpret_cast<const std::uint8_t*>(stream.data()), &unpacked,
                              reinterpret_cast<std::uint8_t*>(data.data()));
  if (!head.whole() || result != BROTLI_DECODER_RESULT_SUCCESS || unpacked != size) return std::nullopt;
  Bytes rest(data);
  for (FontTable& table : tables) table.packed = rest.take(table.size);
  if (!restore(own)) return std::nullopt;
  return fontOf(flavor, {own.begin(), own.end()});
}

}  // namespace

std::optional<std::string> unpackedFont(std::string bytes) {
  if (bytes.starts_with("wOFF")) return fromZlib(bytes);
  if (bytes.starts_with("wOF2")) return fromBrotli(bytes);
  return bytes;
}

}  // namespace sillon
