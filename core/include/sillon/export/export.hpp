// Files for other programs: packed G-code, solids, zones of directions, and drawings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Files that hold G-code: text, text packed by gzip, the zip of Bambu printers and their slicers
// (.gcode.3mf), and Prusa's binary G-code (.bgcode).

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

// The base of a plate as a solid, for printing it with another slicer.

/// A closed surface of triangles, counter-clockwise as seen from outside. Every edge between two
/// points belongs to two triangles, in opposite directions.
struct Mesh {
  /// Points x, y, z on the bed [mm], on the grid of the G-code
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Makes the solid of the base layers, placed as in the G-code, with all copies. No elephant's foot
/// is taken off. The edges of the bed are not checked here, but by writeGcode.
/// \return InvalidArgument (also for a plate without a base), DoesNotFit (in height), EmptyShape,
/// TooLarge.
Result<Mesh> baseBody(const Shape& shape, const Printer& printer, const PrintParams& params);

/// Writes a mesh as binary STL.
/// \return InvalidArgument for a corner that is none of the points, or a point that is not finite.
Result<std::string> writeStl(const Mesh& mesh);

/// Writes a mesh as 3MF with one object, uncompressed. The same mesh gives the same bytes.
/// \return the errors of writeStl.
Result<std::string> write3mf(const Mesh& mesh);

// The field of directions cut into a few zones of one direction each, for slicers that only lay
// straight lines.

/// Limits of the zones.
struct ZoneParams {
  int most = 6;      ///< most directions, 2..12; several parts with one direction count once
  double least = 3;  ///< least width of a zone within the shape [mm], 0.5..100
};

/// A zone in which all lines run one way; it may have several parts.
struct DirectionZone {
  double degrees = 0;  ///< angle, 0 <= degrees < 180, counter-clockwise from +x, whole tenths
  double areaMm2 = 0;  ///< area within the shape
  /// Outlines on the page, inside on their left; beyond the shape they go on to 1 mm off the page
  std::vector<Ring> rings;
};

/// Zones that together cover the page and a border of 1 mm; no two overlap.
struct DirectionZones {
  std::vector<DirectionZone> zones;  ///< zones by angle
  int found = 0;     ///< number of different directions; those with wide enough places became zones
  double error = 0;  ///< mean angle between the map and the zones, over the shape [degrees]
};

// Draws a toolpath as an SVG in mm, with the widths of its beads.

/// Draws one group per cycle: its beads as strokes coloured by direction, and above them the thin,
/// closed line that the nozzle follows. Points are exact to 1 µm. To keep the file small, a stroke
/// joins beads whose widths differ by at most 0.02 mm and whose directions differ by at most 5
/// degrees.
/// \param page  size [mm], 0.001..100000 per side.
/// \return a complete document, the same bytes for the same toolpath; InvalidArgument for a
/// malformed toolpath.
Result<std::string> toolpathSvg(const Toolpath& toolpath, Vec2 page);

}  // namespace sillon
