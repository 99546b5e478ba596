// Zip archives, as 3MF packages use them: written uncompressed.
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

/// Writer of a zip with stored entries. Files are sent once, over a local network, so equal bytes on every platform are
/// worth more than compression.
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

/// Adds the parts that every 3MF begins with: the types of its parts, and the relation that names 3D/3dmodel.model as
/// the model.
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

// Entries of a zip, as listed in its directory.

/// One entry of a zip.
struct ZipEntry {
  std::string_view name;
  std::size_t listed = 0;  ///< offset of its record in the directory
  std::size_t begin = 0;   ///< offset of its local record
  std::size_t end = 0;     ///< offset just past it, where the next one or the directory begins
  std::uint64_t flags = 0;
  std::uint64_t method = 0;  ///< 0 stored, 8 deflated
  std::uint64_t crc = 0;
  std::uint64_t packed = 0;  ///< [bytes]
  std::uint64_t size = 0;    ///< [bytes], unpacked
};

/// Directory of a zip; its names point into the zip.
struct ZipDirectory {
  std::vector<ZipEntry> entries;  ///< entries in the order of the directory
  std::size_t begin = 0;          ///< offset of the directory
  std::size_t end = 0;            ///< offset of the record behind the directory
};

/// Reads the directory of a zip. \return InvalidFile, in words about a .gcode.3mf, if it is broken or cut off.
Result<ZipDirectory> readZip(std::string_view zip);

/// Unpacks an entry and checks its checksum. \param most  largest unpacked size [bytes].
/// \return InvalidFile or TooLarge, in the same words.
Result<std::string> unpackEntry(std::string_view zip, const ZipEntry& entry, std::size_t most);

/// Rewrites a zip with other contents in some entries, which are stored uncompressed. All other entries keep their
/// bytes and their order. \param contents  one list of parts per entry of the directory; an empty list keeps the entry
/// as it is. \param take  receives the zip in pieces.
void withContents(std::string_view zip, const ZipDirectory& directory,
                  const std::vector<std::vector<std::string_view>>& contents,
                  const std::function<void(std::string_view)>& take);

}  // namespace sillon
