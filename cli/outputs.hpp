// Makes the outputs of a finished plate, all in memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files.hpp"
#include "pictures.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/project.hpp"

namespace sillon::cli {

/// File name of each output; empty if it is not wanted.
struct OutputPaths {
  std::string gcode;
  std::string container;  ///< an input: a .gcode.3mf or .bgcode whose other parts are kept around the G-code
  std::string svg;
  std::string report;
  std::string preview;
  int previewWidth = 0;  ///< see previewFiles()
  std::string conflict;
  std::string project;
  std::string view;
  std::string body;
};

/// A finished plate, and further data for its outputs.
struct Job {
  Plate plate;
  PictureOptions pictureOptions;
  std::optional<Error> bodyRefused;  ///< why there is no body; the other outputs are made all the same
  std::string date;                  ///< for line 1 of the G-code
};

/// Returns the date of this run: from SOURCE_DATE_EPOCH [s] if set, otherwise from the clock.
Result<std::string> runDate();

/// Returns the names of the outputs that are wanted.
/// \param pictures  number of pictures; each has a preview.
std::vector<std::string> outputNames(const OutputPaths& paths, std::size_t pictures);

/// Packs G-code by the ending of `path`: .gcode.3mf, .bgcode, .gz, otherwise plain text.
/// \return InvalidArgument for a .3mf that would be taken for a model; TooLarge from packing.
Result<std::string> packedAs(const std::string& path, std::string gcode);

/// Refuses a .gcode.3mf for a printer that cannot read it.
/// \param command  command that would make it: "generate", "calibrate flow".
/// \param container  file from the slicer; empty if none is given.
std::optional<Error> packageProblem(const std::string& path, GcodeFlavor flavor, const std::string& command,
                                    const std::string& container = {});

/// Makes all outputs. Fills job.bodyRefused, and the plate's facts about its G-code.
Result<std::vector<OutputFile>> makeOutputs(Job& job, const OutputPaths& paths, const RunContext& run);

/// Summarises a plate in a few lines for the terminal.
std::string summary(const Plate& plate, const std::vector<OutputFile>& files);

}  // namespace sillon::cli
