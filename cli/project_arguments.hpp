// The project that a command line means: a file, and the options laid over it.
#pragma once

#include <string>
#include <vector>

#include "options.hpp"
#include "pictures.hpp"
#include "sillon/base/result.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/project.hpp"

namespace cli {

struct ProjectArguments {
  std::string scene;  ///< JSON file; empty: options only
  /// Changes that the options make to the scene, in a fixed order whatever the order on the line.
  std::vector<Change> changes;
  PictureOptions pictures;
  /// Beads along the border where pictures are given and no project: they would frame them in tones that they do not
  /// have
  sillon::PerimeterMode besidePictures = sillon::PerimeterMode::None;
};

/// The scene with the options laid over it, every field in range. Reads the file of own spools, if one is named.
sillon::Result<sillon::Project> readProject(ProjectArguments& arguments);

// Options of several commands that change the project.
void addShape(Options& options, std::vector<Change>& changes);
void addLayers(Options& options, std::vector<Change>& changes);
void addPerimeters(Options& options, std::vector<Change>& changes);
void addToolpath(Options& options, std::vector<Change>& changes);
void addPrinter(Options& options, std::vector<Change>& changes);

}  // namespace cli
