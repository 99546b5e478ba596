// Reads a project and its files, the input of the pipeline.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/project/project.hpp"

namespace sillon::cli {

/// Reads a scene and makes its file names relative to the working directory.
Result<Project> loadProject(const std::string& path);

/// Reads and decodes shape, directions and modes.
Result<PlateInput> assemblePlate(const Project& project, const RunContext& run = RunContext());

/// Reads one of a project's files. \param what  kind of file, for messages.
Result<InputFile> readInputFile(const std::string& name, const std::string& what);

/// Returns the names of a project's files.
std::vector<std::string> inputFiles(const Project& project);

/// Formats a project as a file at `path`, with file names relative to its folder.
std::string projectFor(const Project& project, const std::string& path);

}  // namespace sillon::cli
