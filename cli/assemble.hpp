// Reads a project and its files, the input of the pipeline.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/project/project.hpp"

namespace cli {

/// Reads a scene and makes its file names relative to the working directory.
sillon::Result<sillon::Project> loadProject(const std::string& path);

/// Reads and decodes shape, directions and modes.
sillon::Result<sillon::PlateInput> assemblePlate(const sillon::Project& project,
                                                 const sillon::RunContext& run = sillon::RunContext());

/// Reads one of a project's files. \param what  kind of file, for messages.
sillon::Result<sillon::InputFile> readInputFile(const std::string& name, const std::string& what);

/// Returns the names of a project's files.
std::vector<std::string> inputFiles(const sillon::Project& project);

/// Formats a project as a file at `path`, with file names relative to its folder.
std::string projectFor(const sillon::Project& project, const std::string& path);

}  // namespace cli
