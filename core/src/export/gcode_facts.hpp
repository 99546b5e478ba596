// What a G-code file tells of itself in its comments: figures, pictures, settings; and the box of its beads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

/// What is read of figures and pictures: so many bytes at the beginning, and at the end.
inline constexpr std::size_t kTold = std::size_t{1} << 20;

/// The value of "; key = value" or "; key: value" in the first or the last MiB of a file, the last one there; letters,
/// digits, blanks and ".+-#" of it, at most 60. Empty: there is none. \param before  stands before the ";"; empty: the
/// comment may also follow another one in its line.
std::string toldValue(std::string_view gcode, std::string_view key, std::string_view before = "\n");

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

}  // namespace sillon
