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

/// Most text that is read from any container: 256 MiB.
inline constexpr std::size_t kMostGcodeBytes = std::size_t{256} << 20;

/// Kinds of files that hold G-code.
enum class GcodeContainerKind { Text, Package3mf, Binary, Gzip };

/// G-code and the file it came in, so that other G-code can take its place there.
struct GcodeContainer {
  GcodeContainerKind kind = GcodeContainerKind::Text;
  std::string gcode;  ///< text; for a .bgcode, its settings and figures follow as comments
  std::string file;   ///< the whole file, except for plain text
  int plates = 1;     ///< plates with G-code in a .gcode.3mf; `gcode` is the first one's
};

/// Unpacks a file, whose kind its first bytes tell: the first plate of a .gcode.3mf, all blocks of
/// a .bgcode, the text of a .gz, and the bytes of anything else as they are.
/// \return InvalidFile for a container that is damaged, encrypted or holds no G-code; TooLarge
/// above 256 MiB of text.
Result<GcodeContainer> readGcodeContainer(std::string file);

/// Returns the file of `container` with other G-code in it. In a .gcode.3mf all other entries keep
/// their bytes and their order, except for facts in which the new text differs from the old one:
/// the plate's MD5, its pictures, time, weight, and its box where that differs by more than 0.5 mm.
/// A .bgcode keeps its other blocks, except for figures of the same names; its G-code is written
/// plain, without MeatPack or compression. A .gz keeps its header.
/// \return the errors of readGcodeContainer about the container's own file; InvalidArgument where
/// the lists of a .gcode.3mf and the G-code name different filaments, which a printer would feed at
/// the wrong heat; TooLarge above 1 GiB.
Result<std::string> writeGcodeContainer(const GcodeContainer& container, std::string gcode);

/// Does the same in pieces: of a text and of a .gcode.3mf, neither the new text nor the new file is
/// held as a whole.
/// \param gcode  parts of whole lines.
/// \param take  receives the file in pieces of any size; nothing of a file that is refused.
/// \return the error, if any.
[[nodiscard]] std::optional<Error> writeGcodeContainer(
    const GcodeContainer& container, const std::vector<std::string_view>& gcode,
    const std::function<void(std::string_view)>& take);

/// Packs G-code into a new .gcode.3mf, uncompressed. It holds Metadata/plate_1.gcode, its MD5,
/// which the firmware checks, its box, the file's PNG thumbnails, and the time and filament that
/// its own comments tell. Filaments are listed by the number that the G-code loads. The same file
/// gives the same bytes. Such packages have not been tried on a printer.
/// \return InvalidArgument for G-code of other printers than Bambu's, and for G-code that loads
/// several filaments; TooLarge above 1 GiB.
Result<std::string> packGcode(std::string_view gcode);

/// Packs G-code into a new .bgcode: the file's settings, figures and thumbnails as blocks of their
/// own, then its G-code, plain, each block with its CRC-32. The same file gives the same bytes.
/// Such files have not been tried on a printer.
/// \return TooLarge above 1 GiB.
Result<std::string> packBinaryGcode(std::string_view gcode);

/// Packs G-code into a new .gz. The same file gives the same bytes.
/// \return TooLarge above 1 GiB.
Result<std::string> gzipGcode(std::string_view gcode);

/// Returns only the text of readGcodeContainer; what it was packed in is freed.
Result<std::string> unpackGcode(std::string file);

/// Tells by its first bytes whether a file is packed: .gcode.3mf, .bgcode or .gz.
bool isPackedGcode(std::string_view file);

}  // namespace sillon
