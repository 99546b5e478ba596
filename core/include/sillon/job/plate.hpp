// The way to a plate: from a project and the files it names to solved pictures, toolpath, measures,
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
#include "sillon/compose/compose.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/project/project.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/input_note.hpp"
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

/// The paths of a plate that are made.
enum class PlatePath {
  Seen,   ///< the oriented path
  Below,  ///< only the path of the layer below it, which nothing measures (generateAcross)
  Both,
};

/// Options of a plate's making, and what is kept for the next one.
struct PlateOptions {
  Placing placing = Placing::AsGiven;
  PlatePath path = PlatePath::Seen;
  bool measure = true;
  bool countDislocations = false;  ///< among the measures; takes a twentieth of the plate's time
  /// By the toolpath, where it is measured; no need to where checkPlateGcode follows
  bool judgePictures = true;
  Session* session = nullptr;  ///< keeps stages from plate to plate
  /// Keeps solved pictures from plate to plate
  std::optional<KeptPictures>* keptPictures = nullptr;
};

/// A plate, and all that is known of it.
struct Plate {
  Project project;          ///< as it was made: placing may have turned it, or made it smaller
  Composition composition;  ///< its shape, and all that its layers say
  PlateInput input;         ///< the layers laid over the lowest
  ToolpathResult result;    ///< of the path below, where only that was asked for
  std::optional<Toolpath> below;     ///< path of the layer below, where both were asked for
  std::optional<Measures> measures;  ///< none: not asked for
  std::vector<JudgedPicture>
      shown;  ///< one per picture, the lowest layer's first; empty: not judged
  std::vector<SeenLayer>
      seenLayers;   ///< one per visible layer above the lowest that fills the page
  int threads = 1;  ///< that the run was allowed
  // The G-code, once it is written.
  std::optional<GcodeSummary> gcode;
  std::vector<GcodeFinding> findings;   ///< of reading it as a printer would
  std::optional<NeighbourDelay> delay;  ///< of the beads that the G-code lays
  bool judgedByGcode = false;           ///< `shown` is what the G-code lays

  [[nodiscard]] const Toolpath& toolpath() const { return result.toolpath; }
  /// The pictures of the lowest layer.
  [[nodiscard]] const PlatePictures& pictures() const { return composition.pictures; }
  /// Tells what was taken for granted of the input, or left out of it.
  [[nodiscard]] std::vector<InputNote> notes() const;
  /// Warnings about the plate, then about its G-code.
  [[nodiscard]] std::vector<Warning> warnings() const;
  /// All but the memory that it took, which only the program knows.
  [[nodiscard]] Report report() const;
};

/// Makes a plate. Its progress is one fraction, whatever is asked for.
/// \param read  hands over the files that the project names.
/// \return the errors of invalidSettings, readPlateInput, plateTooLarge, compose, generateToolpath,
/// measureToolpath and judgePictures.
Result<Plate> makePlate(Project project, const ReadInput& read, const PlateOptions& options,
                        const RunContext& run);

/// Facts for the G-code that the plate does not know.
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
/// \return the errors of readBack and measurePictures, or what checkPrint finds to be an error in
/// it.
std::optional<Error> checkPlateGcode(Plate& plate, std::string_view gcode, const RunContext& run);

}  // namespace sillon
