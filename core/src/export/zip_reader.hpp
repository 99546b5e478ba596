// What a zip holds, entry by entry, as its directory tells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"

namespace sillon {

struct ZipEntry {
  std::string_view name;
  std::size_t listed = 0;  ///< offset of its record in the directory
  std::size_t begin = 0;   ///< offset of its local record
  std::size_t end = 0;     ///< one past it: where the next one or the directory begins
  std::uint64_t flags = 0;
  std::uint64_t method = 0;  ///< 0 stored, 8 deflated
  std::uint64_t crc = 0;
  std::uint64_t packed = 0;  ///< [bytes]
  std::uint64_t size = 0;    ///< [bytes], unpacked
};

/// A zip's directory; points into the zip.
struct ZipDirectory {
  std::vector<ZipEntry> entries;  ///< as they are listed
  std::size_t begin = 0;          ///< of the directory
  std::size_t end = 0;            ///< of the record behind it
};

/// \return InvalidFile with the words that follow "the .gcode.3mf": broken or cut off.
Result<ZipDirectory> readZip(std::string_view zip);

/// An entry's bytes. \param most  [bytes], unpacked.
/// \return InvalidFile or TooLarge, in words as above.
Result<std::string> unpackEntry(std::string_view zip, const ZipEntry& entry, std::size_t most);

/// The zip with other contents in some entries, which are stored. All other entries keep their bytes and place.
/// \param contents  in parts, by index of the directory, as long as it; no part: the entry keeps its own.
/// \param take  is given the zip in pieces.
void withContents(std::string_view zip, const ZipDirectory& directory,
                  const std::vector<std::vector<std::string_view>>& contents,
                  const std::function<void(std::string_view)>& take);

}  // namespace sillon
