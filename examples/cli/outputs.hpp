// From a finished plate to the texts and pictures that were asked for, all in memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "files.hpp"
#include "sillon/gcode.hpp"
#include "sillon/measure.hpp"
#include "sillon/pipeline.hpp"
#include "sillon/project.hpp"
#include "sillon/run_context.hpp"

namespace cli {

/// A finished plate with all that its outputs tell of it.
struct Job {
  sillon::Project project;
  sillon::PlateInput input;
  sillon::Plate plate;
  std::optional<sillon::Measures> measures;   ///< unset: nobody asked
  std::optional<sillon::GcodeSummary> gcode;  ///< unset: no G-code was asked for
  std::string date;                           ///< for line 1 of the G-code
};

/// The date of this run: SOURCE_DATE_EPOCH [s] if set, else the clock.
sillon::Result<std::string> runDate();

/// Names of the outputs that are wanted.
std::vector<std::string> outputNames(const OutputPaths& paths);

/// Makes every output; fills job.gcode.
sillon::Result<std::vector<OutputFile>> makeOutputs(Job& job, const OutputPaths& paths, const sillon::RunContext& run);

/// What a person wants to know of a plate, in a few lines.
std::string summary(const Job& job, int threads, const std::vector<OutputFile>& files);

}  // namespace cli
