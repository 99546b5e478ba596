// From a finished plate to the texts and pictures that were asked for, all in memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files.hpp"
#include "pictures.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/project.hpp"

namespace cli {

/// The file of each output; empty: not wanted.
struct OutputPaths {
  std::string gcode;
  std::string container;  ///< read: a .gcode.3mf or .bgcode whose other parts the G-code keeps
  std::string svg;
  std::string report;
  std::string preview;
  int previewWidth = 0;  ///< as that of previewFiles
  std::string conflict;
  std::string project;
  std::string view;
  std::string body;
};

/// A finished plate, and what its outputs take besides.
struct Job {
  sillon::Plate plate;
  PictureOptions pictureOptions;
  std::optional<sillon::Error> bodyRefused;  ///< why there is no body; the other outputs are made all the same
  std::string date;                          ///< for line 1 of the G-code
};

/// The date of this run: SOURCE_DATE_EPOCH [s] if set, else the clock.
sillon::Result<std::string> runDate();

/// Names of the outputs that are wanted.
/// \param pictures  each has a preview.
std::vector<std::string> outputNames(const OutputPaths& paths, std::size_t pictures);

/// G-code in the kind of file that the end of `path` asks for: .gcode.3mf, .bgcode, .gz, else text. \return
/// InvalidArgument for a .3mf that would be taken for a model; TooLarge as packing does.
sillon::Result<std::string> packedAs(const std::string& path, std::string gcode);

/// Refuses a .gcode.3mf for a printer that reads none. \param command  that would make it: "generate", "calibrate
/// flow". \param container  the slicer's file; empty: none is given.
std::optional<sillon::Error> packageProblem(const std::string& path, sillon::GcodeFlavor flavor,
                                            const std::string& command, const std::string& container = {});

/// Makes every output; fills job.bodyRefused, and what the plate tells of its G-code.
sillon::Result<std::vector<OutputFile>> makeOutputs(Job& job, const OutputPaths& paths, const sillon::RunContext& run);

/// The facts of a plate that a person wants to know, in a few lines.
std::string summary(const sillon::Plate& plate, const std::vector<OutputFile>& files);

}  // namespace cli
