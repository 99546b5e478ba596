#include "input/gzip.hpp"

#include "base/checksums.hpp"
#include "base/deflate.hpp"
#include "input/inflate.hpp"
#include "sillon/base/types.hpp"

namespace sillon {
namespace {

constexpr std::size_t kHeader = 10;
constexpr std::size_t kTrailer = 8;  // checksum and size

Error damaged(Reason reason) { return refusedFile(reason, {{"file", ".gz"}}); }

// Returns the offset of the first byte after the header, or 0 if the header is cut off.
std::size_t endOfHeader(std::string_view file) {
  if (file.size() < kHeader + kTrailer || file[2] != '\x08') return 0;
  const auto flags = static_cast<std::uint8_t>(file[3]);
  std::size_t at = kHeader;
  if ((flags & 4) != 0) {
    if (at + 2 > file.size()) return 0;
    at += 2 + number(file, at, 2);
  }
  for (const int text : {8, 16}) {  // name, comment
    if ((flags & text) == 0) continue;
    const std::size_t end = file.find('\0', at);
    if (end == std::string_view::npos) return 0;
    at = end + 1;
  }
  if ((flags & 2) != 0) at += 2;
  return at + kTrailer <= file.size() ? at : 0;
}

// Tells whether the data are those of an empty text, as gzip, zlib and this program write it. Such data must be
// recognised here: inflating needs a size, and a file that is cut off among zeros has none.
bool isEmpty(std::string_view data) {
  return data == std::string_view("\3\0", 2) || data == std::string_view("\1\0\0\xff\xff", 5) || data == deflated({});
}

Result<std::string> packed(std::string header, std::string_view text) {
  if (const auto problem = tooLargeToPack(text.size())) return *problem;
  header += deflated(text);
  append(header, crc32(text), 4);
  append(header, text.size(), 4);
  return header;
}

}  // namespace

Result<std::string> gunzipped(std::string_view file, std::size_t most) {
  const std::size_t begin = endOfHeader(file);
  if (begin == 0) return damaged("PackedCutOff");
  const auto size = toSize(number(file, file.size() - 4, 4));
  const std::string_view data = file.substr(begin, file.size() - kTrailer - begin);
  if (size > most) return fileTooLarge(size, most);
  if (size > data.size() * kBestDeflate) return damaged("PackedDamaged");
  // The data include 4 bytes of the trailer, because stb_image's inflate reads that far beyond the end.
  std::optional<std::string> text;
  if (size > 0) {
    text = inflated(file.substr(begin, data.size() + 4), size);
  } else if (isEmpty(data)) {
    text.emplace();
  }
  if (!text || crc32(*text) != number(file, file.size() - kTrailer, 4)) {
    return damaged("PackedDamaged");
  }
  return std::move(*text);
}

Result<std::string> gzippedLike(std::string_view file, std::string_view text) {
  const std::size_t begin = endOfHeader(file);
  if (begin == 0) return damaged("PackedCutOff");
  return packed(std::string(file.substr(0, begin)), text);
}

Result<std::string> gzipped(std::string_view text) {
  return packed(std::string("\x1f\x8b\x08\0\0\0\0\0\0\xff", kHeader), text);
}

}  // namespace sillon
