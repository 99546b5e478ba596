// Zip archives as 3MF packages use them, uncompressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/crc32.hpp"
#include "export/bytes.hpp"

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

}  // namespace sillon
