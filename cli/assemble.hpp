// From a project and the files it names to what the pipeline eats.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/project/project.hpp"

namespace cli {

/// Reads a scene; its file names come back relative to the working directory.
sillon::Result<sillon::Project> loadProject(const std::string& path);

/// Reads and decodes shape, directions and modes.
sillon::Result<sillon::PlateInput> assemblePlate(const sillon::Project& project,
                                                 const sillon::RunContext& run = sillon::RunContext());

/// Reads one file that a project names.
sillon::Result<sillon::InputFile> readInputFile(const std::string& name, const std::string& what);

/// The files a project names.
std::vector<std::string> inputFiles(const sillon::Project& project);

/// The project as a file at `path` would say it: file names relative to its folder.
std::string projectFor(const sillon::Project& project, const std::string& path);

}  // namespace cli
