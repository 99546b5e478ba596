// Packed files: checksums, facts of G-code, and Prusa's binary G-code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/gzip.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

// MD5, which Bambu's firmware checks.

/// MD5 of a text (RFC 1321), as upper-case hexadecimal digits.
std::string md5(std::string_view text);

/// MD5 of a text in parts.
std::string md5(const std::vector<std::string_view>& parts);

// Facts about a G-code file: figures, pictures and settings from its comments, and the box of its beads.

/// Bytes at the beginning and at the end of a file that are searched for figures and pictures.
inline constexpr std::size_t kTold = std::size_t{1} << 20;

/// Finds the value of "; key = value" or "; key: value" in the last or the first MiB of a file; the last such comment
/// counts. The value keeps its letters, digits, blanks and ".+-#", at most 60. \return empty: there is none.
/// \param before  text before the ";"; if it is empty, the comment may also follow another one in its line.
/// \param item  index in a list, from 0; a shorter list gives its last item.
std::string toldValue(std::string_view gcode, std::string_view key, std::string_view before = "\n",
                      std::size_t item = 0);

/// Reads a duration such as "1h 2m 3s" [s].
std::uint64_t toldSeconds(std::string_view text);

/// Reads a number such as "12.5"; nothing if the text holds anything else.
std::optional<double> plainNumber(std::string_view text);

/// A thumbnail from a file's comments.
struct ToldPicture {
  int width = 0;
  int height = 0;
  std::string format;  ///< "PNG", "JPG" or "QOI"
  std::string bytes;
};

/// Finds the thumbnails in a file's comments, in their order.
std::vector<ToldPicture> toldPictures(std::string_view gcode);

/// Finds the box around the ends of all beads after the first layer mark, without start and end blocks; empty if there
/// are none. \param gcode  in parts of whole lines.
Bounds printedBox(const std::vector<std::string_view>& gcode);

// The filaments that a .gcode.3mf and its G-code name. They must agree, because the printer feeds the filaments of the
// package at the temperature of the G-code.

/// A range of bytes in a text; none if `end` is 0.
struct TextRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Finds the value of `name="..."`, the first after `from` and before `to`, if there is one.
TextRange attribute(std::string_view xml, std::string_view before, std::string_view name, std::size_t from,
                    std::size_t to);

/// Finds the filaments that the G-code loads, numbered from 0, in rising order. \param gcode  in parts of whole lines.
std::vector<int> loadedFilaments(const std::vector<std::string_view>& gcode);

/// The lists in which a package describes one plate.
struct PlateLists {
  std::string_view sliceInfo;  ///< the plate's part of slice_info.config
  std::string_view plateInfo;  ///< the plate's JSON; empty: there is none
};

/// The filaments that a G-code loads, and its comments about them.
struct FilamentsOfGcode {
  std::vector<int> loaded;
  std::string_view text;  ///< text for toldValue
};

/// Checks that G-code may replace that of a package. \return the error if the package lists other filaments than the
/// new G-code loads: of other numbers or kinds, or more of them.
std::optional<Error> packageDisagrees(const PlateLists& lists, const FilamentsOfGcode& before,
                                      const FilamentsOfGcode& after);

// Prusa's binary G-code, version 1: https://github.com/prusa3d/libbgcode/blob/main/doc/specifications.md

/// Tells whether a file begins as binary G-code.
inline bool isBinaryGcode(std::string_view bytes) { return bytes.starts_with("GCDE"); }

/// Unpacks all G-code of a file, followed by its settings and figures as comments. \return errors as
/// readGcodeContainer.
Result<std::string> binaryToText(std::string_view file);

/// Replaces the G-code of a file by that of `text`, and figures by those of the same name in its comments.
/// \return errors as writeGcodeContainer.
Result<std::string> binaryWithText(std::string_view file, std::string_view text);

/// Undoes heatshrink compression with a window of 2^windowBits bytes and runs of at most 2^4. \return at most `most`
/// bytes.
std::string unshrunk(std::string_view data, int windowBits, std::size_t most);

/// Undoes MeatPack, and restores the blank before each word of a G command, which packing leaves out.
std::string unmeatpacked(std::string_view data);

/// Tells by its first bytes whether a file is packed: .gcode.3mf, .bgcode or .gz.
bool isPackedGcode(std::string_view file);

}  // namespace sillon
