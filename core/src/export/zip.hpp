// Zip archives as 3MF packages use them, uncompressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/checksums.hpp"
#include "export/packing.hpp"
#include "sillon/base/result.hpp"

namespace sillon {

/// A zip of stored entries: files are sent once, over a local network, and the same bytes everywhere are worth more.
class Zip {
 public:
  void add(std::string_view name, std::string_view bytes) {
    std::string common;
    append(common, 10, 2);  // version 1.0
    append(common, 0, 2);
    append(common, 0, 2);           // stored
    append(common, 0x00210000, 4);  // midnight of 1980-01-01
    append(common, crc32(bytes), 4);
    append(common, bytes.size(), 4);
    append(common, bytes.size(), 4);
    append(common, name.size(), 2);
    append(common, 0, 2);
    append(directory_, 0x02014b50, 4);
    append(directory_, 10, 2);
    directory_ += common;
    append(directory_, 0, 10);  // no comment, first disk, no attributes
    append(directory_, out_.size(), 4);
    directory_ += name;
    ++count_;
    append(out_, 0x04034b50, 4);
    out_ += common;
    out_ += name;
    out_ += bytes;
  }

  std::string finish() {
    const std::size_t begin = out_.size();
    out_ += directory_;
    append(out_, 0x06054b50, 4);
    append(out_, 0, 4);
    append(out_, count_, 2);
    append(out_, count_, 2);
    append(out_, directory_.size(), 4);
    append(out_, begin, 4);
    append(out_, 0, 2);
    return std::move(out_);
  }

 private:
  std::string out_;
  std::string directory_;
  std::uint64_t count_ = 0;
};

inline constexpr const char* kXml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

/// What every 3MF begins with: the types of its parts, and that the model is 3D/3dmodel.model.
inline void addPackageParts(Zip& zip, std::string_view moreTypes = "") {
  zip.add(
      "[Content_Types].xml",
      std::string(kXml) +
          "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
          " <Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
          " <Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n" +
          std::string(moreTypes) + "</Types>\n");
  zip.add("_rels/.rels",
          std::string(kXml) +
              "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
              " <Relationship Target=\"/3D/3dmodel.model\" Id=\"rel-1\" "
              "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n</Relationships>\n");
}

// Entries of a zip, as its directory tells them.

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
