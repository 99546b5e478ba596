// Files that hold G-code: text, text packed by gzip, the zip of Bambu printers and their slicers
// (.gcode.3mf), and Prusa's binary G-code (.bgcode).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"

namespace sillon {

/// Most text that is read of any container.
inline constexpr std::size_t kMostGcodeBytes = std::size_t{256} << 20;

enum class GcodeContainerKind { Text, Package3mf, Binary, Gzip };

/// G-code and the file it came in, so that other G-code can take its place there.
struct GcodeContainer {
  GcodeContainerKind kind = GcodeContainerKind::Text;
  std::string gcode;  ///< text; of a .bgcode with its settings and figures as comments behind it
  std::string file;   ///< the whole file, but of text
  int plates = 1;     ///< with G-code in a .gcode.3mf, of which the first is here
};

/// Unpacks a file by its first bytes: of a .gcode.3mf the first plate, of a .bgcode all its blocks,
/// of anything else the bytes as they are.
/// \return InvalidFile for a container that is damaged, encrypted or holds no G-code; TooLarge
/// above 256 MiB of text.
Result<GcodeContainer> readGcodeContainer(std::string file);

/// The file of `container` with other G-code in it. Of a .gcode.3mf all other entries keep their
/// bytes and their order, but for what the new text tells otherwise than the old one: the plate's
/// MD5, its pictures, time, weight, and its box where that is another by more than 0.5 mm. A
/// .bgcode keeps its other blocks, but for figures of the same names; its G-code is written plain,
/// without MeatPack or compression. A .gz keeps its header.
/// \return as readGcodeContainer, of the container's own file; InvalidArgument where the lists of a
/// .gcode.3mf and the G-code name different filaments, which a printer would feed at the wrong
/// heat; TooLarge above 1 GiB.
Result<std::string> writeGcodeContainer(const GcodeContainer& container, std::string gcode);

/// The same in pieces: of a text and of a .gcode.3mf neither the new text nor the new file is held.
/// \param gcode  in parts of whole lines.
/// \param take  is given the file in pieces of any size; nothing of one that is refused.
/// \return the error, if any.
[[nodiscard]] std::optional<Error> writeGcodeContainer(
    const GcodeContainer& container, const std::vector<std::string_view>& gcode,
    const std::function<void(std::string_view)>& take);

/// Packs G-code into a new .gcode.3mf, uncompressed. It holds Metadata/plate_1.gcode, its MD5 that
/// the firmware checks, its box, the file's PNG thumbnails and what its own comments say of time
/// and filament, which it lists by the number that the G-code loads. The same bytes for the same
/// file. Not tried on a printer.
/// \return InvalidArgument for G-code of other printers than Bambu's, and for one that loads
/// several filaments; TooLarge above 1 GiB.
Result<std::string> packGcode(std::string_view gcode);

/// A new .bgcode: the file's settings, figures and thumbnails as blocks of their own, then its
/// G-code, plain, each block with its CRC-32. The same bytes for the same file. Not tried on a
/// printer.
/// \return TooLarge above 1 GiB.
Result<std::string> packBinaryGcode(std::string_view gcode);

/// A new .gz. The same bytes for the same file.
/// \return TooLarge above 1 GiB.
Result<std::string> gzipGcode(std::string_view gcode);

/// The text of readGcodeContainer alone; what it was packed in is freed.
Result<std::string> unpackGcode(std::string file);

/// Whether a file is packed, by its first bytes: .gcode.3mf, .bgcode or .gz.
bool isPackedGcode(std::string_view file);

}  // namespace sillon
