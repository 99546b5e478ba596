#include <algorithm>
#include <string>
#include <utility>

#include "base/refused.hpp"
#include "gcode/read_back.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/job/plate.hpp"

namespace sillon {

std::optional<Error> writePlateGcode(Plate& plate, const PlateGcodeOptions& options, const GcodeSink& sink,
                                     const RunContext& run) {
  const Project& project = plate.project;
  // A plate without pictures gets the same thumbnails whatever its spool.
  LookParams look;
  if (!plate.pictures().shown.empty()) {
    look = lookOf(project, plate.pictures(), 0);
    if (options.colour) look.colour = *options.colour;
  }
  if (needsAcross(project.print) && !plate.below) {
    auto made = generateAcross(plate.input, project.toolpath, run);
    if (!made) return made.error();
    plate.below = std::move(made).value().toolpath;
  }
  const PathToWrite path{plate.toolpath(),
                         plate.input.shape,
                         plate.below ? &*plate.below : nullptr,
                         look,
                         plateNotes(project.toolpath, plate.measures),
                         options.date};
  auto summary = writePathGcode(path, project.printer, project.print, sink, run);
  if (!summary) return summary.error();
  plate.gcode = std::move(summary).value();
  return std::nullopt;
}

std::optional<Error> checkPlateGcode(Plate& plate, std::string_view gcode, const RunContext& run) {
  const Project& project = plate.project;
  // The file is checked by its own content only, as `check` does, so that everybody who gets the file comes to the same
  // verdict.
  GcodeCheck check = checkPrint(gcode).check;
  const auto fault = std::find_if(check.findings.begin(), check.findings.end(),
                                  [](const GcodeFinding& finding) { return finding.error; });
  if (fault != check.findings.end()) {
    return refusedArgument("CheckRefuses", {{"what", fault->message}, {"line", fault->line}});
  }
  plate.findings = std::move(check.findings);
  plate.delay = check.delay;
  if (!plate.composition.showsPictures() || !plate.measures) return std::nullopt;
  const auto read = readBack(gcode, plate.input.shape, project.printer, project.print, plate.toolpath().spacing);
  if (!read) return read.error();
  auto shown = judgePictures(plate.composition, read.value(), run);
  if (!shown) return shown.error();
  plate.shown = std::move(shown).value();
  plate.judgedByGcode = true;
  return std::nullopt;
}

}  // namespace sillon
