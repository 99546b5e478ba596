// Project of a command line: a file, with options applied to it.
#pragma once

#include <string>
#include <vector>

#include "options.hpp"
#include "pictures.hpp"
#include "sillon/base/result.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/project.hpp"

namespace sillon::cli {

struct ProjectArguments {
  std::string scene;  ///< JSON file; empty if only options are given
  /// Changes of the options to the scene, in a fixed order whatever the order on the line.
  std::vector<Change> changes;
  PictureOptions pictures;
  /// Mode of the border when pictures are given without a project. Beads along the border would frame the pictures in
  /// tones that they do not have.
  PerimeterMode besidePictures = PerimeterMode::None;
};

/// Reads the scene, applies the options and checks the range of every field. Also reads the file of own spools.
Result<Project> readProject(ProjectArguments& arguments);

// Options that change the project, shared by several commands.
void addShape(Options& options, std::vector<Change>& changes);
void addLayers(Options& options, std::vector<Change>& changes);
void addPerimeters(Options& options, std::vector<Change>& changes);
void addToolpath(Options& options, std::vector<Change>& changes);
void addPrinter(Options& options, std::vector<Change>& changes);

}  // namespace sillon::cli
