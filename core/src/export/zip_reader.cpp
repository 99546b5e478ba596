#include "export/zip.hpp"

#include <algorithm>
#include <optional>

#include "base/refused.hpp"
#include "base/sort_key.hpp"
#include "input/inflate.hpp"

namespace sillon {
namespace {

constexpr std::size_t kListedSize = 46;
constexpr std::size_t kLocalSize = 30;
constexpr std::size_t kEndSize = 22;
constexpr std::size_t kMostComment = 65535;
constexpr std::uint64_t kUtf8Names = 0x0800;

Error damaged(Reason reason) { return refusedFile(reason, {{"file", ".gcode.3mf"}}); }

}  // namespace

Result<ZipDirectory> readZip(std::string_view zip) {
  const std::size_t from = zip.size() - std::min(zip.size(), kEndSize + kMostComment);
  const std::size_t last = zip.substr(from).rfind("PK\x05\x06");
  if (last == std::string_view::npos || from + last + kEndSize > zip.size()) return damaged("PackedCutOff");
  ZipDirectory directory;
  directory.end = from + last;
  const std::uint64_t count = number(zip, directory.end + 10, 2);
  std::uint64_t at = number(zip, directory.end + 16, 4);
  directory.begin = toSize(at);
  std::vector<std::size_t> begins;
  for (std::uint64_t k = 0; k < count; ++k) {
    if (at + kListedSize > directory.end || number(zip, toSize(at), 4) != 0x02014b50) {
      return damaged("PackedDamaged");
    }
    ZipEntry entry;
    entry.listed = toSize(at);
    const std::uint64_t name = number(zip, entry.listed + 28, 2);
    if (at + kListedSize + name > directory.end) return damaged("PackedDamaged");
    entry.name = zip.substr(entry.listed + kListedSize, toSize(name));
    entry.flags = number(zip, entry.listed + 8, 2);
    entry.method = number(zip, entry.listed + 10, 2);
    entry.crc = number(zip, entry.listed + 16, 4);
    entry.packed = number(zip, entry.listed + 20, 4);
    entry.size = number(zip, entry.listed + 24, 4);
    const std::uint64_t begin = number(zip, entry.listed + 42, 4);
    if (begin + kLocalSize > directory.begin) return damaged("PackedDamaged");
    entry.begin = toSize(begin);
    begins.push_back(entry.begin);
    directory.entries.push_back(entry);
    at += kListedSize + name + number(zip, entry.listed + 30, 2) + number(zip, entry.listed + 32, 2);
  }
  std::sort(begins.begin(), begins.end());
  for (ZipEntry& entry : directory.entries) {
    const auto next = std::upper_bound(begins.begin(), begins.end(), entry.begin);
    entry.end = std::min(next == begins.end() ? directory.begin : *next, directory.begin);
    if (entry.begin + kLocalSize > entry.end) return damaged("PackedDamaged");
  }
  return directory;
}

Result<std::string> unpackEntry(std::string_view zip, const ZipEntry& entry, std::size_t most) {
  if ((entry.flags & 1) != 0) return damaged("PackedEncrypted");
  if (entry.method != 0 && entry.method != 8) return damaged("PackedUnknown");
  if (entry.size > most) return fileTooLarge(toSize(entry.size), most);
  if (number(zip, entry.begin, 4) != 0x04034b50) return damaged("PackedDamaged");
  const std::uint64_t data =
      entry.begin + kLocalSize + number(zip, entry.begin + 26, 2) + number(zip, entry.begin + 28, 2);
  if (data + entry.packed > zip.size() || entry.size > entry.packed * kBestDeflate ||
      (entry.method == 0 && entry.size != entry.packed)) {
    return damaged("PackedDamaged");
  }
  // stb_image's inflate reads 4 bytes past the end, where at least the directory follows.
  const auto begin = toSize(data);
  const auto length = toSize(entry.packed);
  std::optional<std::string> out = entry.method == 0 ? std::string(zip.substr(begin, length))
                                                     : inflated(zip.substr(begin, length + 4), toSize(entry.size));
  if (!out || crc32(*out) != entry.crc) return damaged("PackedDamaged");
  return std::move(*out);
}

void withContents(std::string_view zip, const ZipDirectory& directory,
                  const std::vector<std::vector<std::string_view>>& contents,
                  const std::function<void(std::string_view)>& take) {
  // Entries are written in the order of the file, which may differ from that of the directory.
  std::vector<std::size_t> order(directory.entries.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  sortBy(order, [&](std::size_t entry) { return directory.entries[entry].begin; });
  struct Stored {
    std::uint64_t begin = 0;
    std::uint64_t size = 0;
    std::uint32_t crc = 0;
  };
  std::vector<Stored> stored(order.size());
  std::uint64_t written = 0;
  const auto give = [&](std::string_view bytes) {
    take(bytes);
    written += bytes.size();
  };
  for (const std::size_t k : order) {
    const ZipEntry& entry = directory.entries[k];
    stored[k].begin = written;
    if (contents[k].empty()) {
      give(zip.substr(entry.begin, entry.end - entry.begin));
      continue;
    }
    Crc32 crc;
    for (const std::string_view part : contents[k]) {
      crc.add(part);
      stored[k].size += part.size();
    }
    stored[k].crc = crc.value();
    std::string head;
    append(head, 0x04034b50, 4);
    append(head, 10, 2);  // version 1.0
    append(head, entry.flags & kUtf8Names, 2);
    append(head, 0, 2);                        // stored
    head += zip.substr(entry.listed + 12, 4);  // date and time
    append(head, stored[k].crc, 4);
    append(head, stored[k].size, 4);
    append(head, stored[k].size, 4);
    append(head, entry.name.size(), 2);
    append(head, 0, 2);
    head += entry.name;
    give(head);
    for (const std::string_view part : contents[k]) give(part);
  }
  const std::uint64_t begin = written;
  for (std::size_t k = 0; k < directory.entries.size(); ++k) {
    const ZipEntry& entry = directory.entries[k];
    const std::size_t next = k + 1 < directory.entries.size() ? directory.entries[k + 1].listed : directory.end;
    std::string record(zip.substr(entry.listed, next - entry.listed));
    const auto put = [&](std::size_t at, std::uint64_t value, int bytes) {
      std::string digits;
      append(digits, value, bytes);
      record.replace(at, digits.size(), digits);
    };
    put(42, stored[k].begin, 4);
    if (!contents[k].empty()) {
      put(6, 10, 2);
      put(8, entry.flags & kUtf8Names, 2);
      put(10, 0, 2);
      put(16, stored[k].crc, 4);
      put(20, stored[k].size, 4);
      put(24, stored[k].size, 4);
    }
    give(record);
  }
  std::string tail(zip.substr(directory.end));
  std::string size;
  append(size, written - begin, 4);
  append(size, begin, 4);
  tail.replace(12, 8, size);
  give(tail);
}

}  // namespace sillon
