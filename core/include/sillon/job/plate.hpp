// Makes a plate from a project and the files that it names: solved pictures, toolpath, measures,
// warnings and report.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/export/export.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/project/project.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/report.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Ways to deal with a plate that does not fit the bed where it lies.
enum class Placing {
  AsGiven,
  Rotate,  ///< centred, and turned by 90 degrees if only that fits
  Fit,     ///< also made smaller, in whole percent, if that does not fit either
};

/// Paths of a plate that may be made.
enum class PlatePath {
  Seen,   ///< the oriented path
  Below,  ///< only the path of the layer below it, which nothing measures (generateAcross)
  Both,
};

/// Options for making a plate, and results that are kept for the next one.
struct PlateOptions {
  Placing placing = Placing::AsGiven;
  PlatePath path = PlatePath::Seen;
  bool measure = true;
  bool countDislocations = false;  ///< count them among the measures; takes 5 % of the plate's time
  /// Judge pictures by the toolpath, if it is measured; not needed where checkPlateGcode follows
  bool judgePictures = true;
  Session* session = nullptr;  ///< keeps stages from plate to plate
  /// Solved pictures kept from plate to plate
  std::optional<KeptPictures>* keptPictures = nullptr;
};

/// A plate, and all that is known of it.
struct Plate {
  Project project;          ///< the project as made: placing may have turned it, or made it smaller
  Composition composition;  ///< its shape, and all that its layers say
  PlateInput input;         ///< the layers laid over the lowest
  /// The path below where only that was asked for, otherwise the oriented path
  ToolpathResult result;
  std::optional<Toolpath> below;     ///< path of the layer below, where both were asked for
  std::optional<Measures> measures;  ///< unset: not asked for
  /// Judgement of each picture, the lowest layer's first; empty: not judged
  std::vector<JudgedPicture> shown;
  std::vector<SeenLayer> seenLayers;  ///< visible layers above the lowest one that fills the page
  int threads = 1;                    ///< number of threads that the run was allowed
  // The G-code, once it is written.
  std::optional<GcodeSummary> gcode;
  std::vector<GcodeFinding> findings;   ///< findings of reading it as a printer would
  std::optional<NeighbourDelay> delay;  ///< wait for neighbours of the beads that the G-code lays
  bool judgedByGcode = false;           ///< `shown` judges the beads that the G-code lays

  [[nodiscard]] const Toolpath& toolpath() const { return result.toolpath; }
  /// Returns the pictures of the lowest layer.
  [[nodiscard]] const PlatePictures& pictures() const { return composition.pictures; }
  /// Returns notes on what was taken for granted of the input, or left out of it.
  [[nodiscard]] std::vector<InputNote> notes() const;
  /// Returns the warnings about the plate, then those about its G-code.
  [[nodiscard]] std::vector<Warning> warnings() const;
  /// Returns the report, except for the memory that the plate took, which only the program knows.
  [[nodiscard]] Report report() const;
};

/// Makes a plate. Its progress is one fraction, whatever is asked for.
/// \param read  hands over the files that the project names.
/// \return the errors of invalidSettings, readPlateInput, plateTooLarge, compose, generateToolpath,
/// measureToolpath and judgePictures.
Result<Plate> makePlate(Project project, const ReadInput& read, const PlateOptions& options,
                        const RunContext& run);

/// Facts for the G-code that the plate does not hold.
struct PlateGcodeOptions {
  std::string date = PrintParams().date;
  /// Colour of the thumbnails of pictures; none: the project's spool
  std::optional<std::array<std::uint8_t, 3>> colour;
};

/// Writes the G-code of a plate, with its notes and thumbnails. The path below it is made if the
/// project needs one and the plate has none. Fills Plate::gcode.
/// \return the errors of lookThumbnails, generateAcross and writeGcode.
std::optional<Error> writePlateGcode(Plate& plate, const PlateGcodeOptions& options,
                                     const GcodeSink& sink, const RunContext& run);

/// Reads the plate's G-code as a printer would. Where the plate was measured, its pictures are
/// judged by the beads that the file lays. Fills Plate::findings and Plate::shown.
/// \param gcode  the whole text that writePlateGcode wrote.
/// \return the errors of readBack and judgePictures, or the first error that checkPrint finds.
std::optional<Error> checkPlateGcode(Plate& plate, std::string_view gcode, const RunContext& run);

// Writes the G-code of a path, with or without the plate that it came from.

/// A path to write, with the notes and the look that its file shows.
struct PathToWrite {
  const Toolpath& seen;
  const Shape& shape;
  const Toolpath* below = nullptr;  ///< path of the layer below, where needsAcross
  LookParams look;                  ///< look of the thumbnails
  std::vector<std::string> notes;   ///< lines of the header, instead of the print's own
  std::string date = PrintParams().date;
};

/// Writes the G-code of a path, with its notes and with the thumbnails that the printer's screen
/// takes. The writing ends where the run is cancelled.
/// \return the errors of lookThumbnails and writeGcode.
Result<GcodeSummary> writePathGcode(const PathToWrite& path, const Printer& printer,
                                    const PrintParams& print, const GcodeSink& sink,
                                    const RunContext& run);

// Makes a body with zones of straight lines, which any slicer can print, from a project.

/// The place of a level top face of a body.
struct BodyFace {
  Vec2 corner;   ///< corner of the box around it [mm]
  double z = 0;  ///< height of the face [mm]
};

/// The zones that are asked for.
struct ZonesRequest {
  /// Bytes of an STL whose top faces get the zones; unset: a prism of the project's shape
  std::optional<std::string> body;
  /// Face of the body that carries the project's shape and alone gets the zones
  std::optional<BodyFace> face;
  double height = 2;  ///< height of that prism [mm]
  ZoneParams params;
  double layerHeight = 0.2;  ///< layer height that the slicer is told [mm]
};

/// The zones that were made.
struct ZonesMade {
  std::string package;  ///< bytes of a 3MF
  DirectionZones zones;
  std::size_t openEdges = 0;  ///< number of edges at which the body is open
  std::vector<InputNote> notes;
  std::vector<Warning> warnings;
};

/// Lays a project's layers on the top of a body, and cuts their directions into zones. Directions
/// that vary become steps; DirectionZones::error tells how far off they are.
/// \return the errors of invalidSettings, readPlateInput, compose, readStl, directionZones and
/// zones3mf; InvalidArgument for layers whose mode is not constrained.
Result<ZonesMade> makeZones(const Project& project, const ZonesRequest& request,
                            const ReadInput& read, const RunContext& run);

}  // namespace sillon
