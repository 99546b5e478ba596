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

/// RFC 1321, in upper case.
std::string md5(std::string_view text);

/// The same of a text in parts.
std::string md5(const std::vector<std::string_view>& parts);

// Facts that a G-code file tells of itself in comments: figures, pictures, settings; and the box of its beads.

/// Reach of reading for figures and pictures: so many bytes at the beginning, and at the end.
inline constexpr std::size_t kTold = std::size_t{1} << 20;

/// The value of "; key = value" or "; key: value" in the first or the last MiB of a file, the last one there; letters,
/// digits, blanks and ".+-#" of it, at most 60. Empty: there is none. \param before  stands before the ";"; empty: the
/// comment may also follow another one in its line. \param item  of a list, from 0; of a shorter one the last.
std::string toldValue(std::string_view gcode, std::string_view key, std::string_view before = "\n",
                      std::size_t item = 0);

/// "1h 2m 3s" in seconds.
std::uint64_t toldSeconds(std::string_view text);

/// A number such as "12.5" and nothing else.
std::optional<double> plainNumber(std::string_view text);

struct ToldPicture {
  int width = 0;
  int height = 0;
  std::string format;  ///< "PNG", "JPG" or "QOI"
  std::string bytes;
};

/// The thumbnails in a file's comments, in its order.
std::vector<ToldPicture> toldPictures(std::string_view gcode);

/// Around the ends of all beads after the first layer mark, start and end blocks left out; empty without any.
/// \param gcode  in parts of whole lines.
Bounds printedBox(const std::vector<std::string_view>& gcode);

// The filaments that a .gcode.3mf and its G-code name: a printer feeds those of the package at the heat of the G-code.

/// Some bytes of a text.
struct Place {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Finds the value of `name="..."`, the first after `from` and before `to`; both ends are 0 where there is none.
Place attribute(std::string_view xml, std::string_view before, std::string_view name, std::size_t from, std::size_t to);

/// Filaments that the G-code loads, from 0, rising. \param gcode  in parts of whole lines.
std::vector<int> loadedFilaments(const std::vector<std::string_view>& gcode);

/// Lists in which a package describes one plate.
struct PlateLists {
  std::string_view sliceInfo;  ///< its part of slice_info.config
  std::string_view plateInfo;  ///< its JSON; empty: there is none
};

struct FilamentsOfGcode {
  std::vector<int> loaded;
  std::string_view text;  ///< what toldValue reads
};

/// The error where a package lists other filaments than the G-code loads that takes the place of its own: others by
/// number or by kind, or more than it loads.
std::optional<Error> packageDisagrees(const PlateLists& lists, const FilamentsOfGcode& before,
                                      const FilamentsOfGcode& after);

// Prusa's binary G-code, version 1: https://github.com/prusa3d/libbgcode/blob/main/doc/specifications.md

inline bool isBinaryGcode(std::string_view bytes) { return bytes.starts_with("GCDE"); }

/// All G-code of the file, then its settings and figures as comments. \return as readGcodeContainer.
Result<std::string> binaryToText(std::string_view file);

/// The file with the G-code of `text`, and with figures of its comments in the place of those of the same names.
/// \return as writeGcodeContainer.
Result<std::string> binaryWithText(std::string_view file, std::string_view text);

/// Undoes heatshrink, of a window of 2^windowBits bytes and runs of at most 2^4. \return at most `most` bytes.
std::string unshrunk(std::string_view data, int windowBits, std::size_t most);

/// Undoes MeatPack, and puts a blank before each word of a G command, which packing leaves out.
std::string unmeatpacked(std::string_view data);

}  // namespace sillon
