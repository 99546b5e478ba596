// The command line as values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate.hpp"
#include "options.hpp"
#include "pictures.hpp"
#include "rebrush.hpp"
#include "shape.hpp"
#include "sillon/base/result.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/project/project.hpp"
#include "zones.hpp"

namespace cli {

/// Where each output goes; empty: not wanted.
struct OutputPaths {
  std::string gcode;
  std::string container;  ///< read: a .gcode.3mf or .bgcode whose other parts the G-code keeps
  std::string svg;
  std::string report;
  std::string preview;
  int previewWidth = 1600;  ///< of each panel [pixels]
  std::string conflict;
  std::string project;
  std::string view;
  std::string body;
};

struct Arguments {
  std::string answer;      ///< help, version or a list: print it, done
  std::string command;     ///< "generate", "check", ...: what was asked for, if there is no answer yet
  std::string check;       ///< G-code file to check
  std::string import;      ///< file to take a printer from
  std::string importName;  ///< printer of a bundle; empty: the active one
  std::optional<sillon::Printer> checkPrinter;
  bool checkJson = false;
  RebrushArguments rebrush;
  ZonesArguments zones;
  CalibrateArguments calibrate;
  ShapeArguments shape;
  std::string scene;  ///< JSON file; empty: options only
  /// What the options change in the scene, in a fixed order whatever the order on the line. Each returns what is wrong.
  std::vector<Change> changes;
  PictureOptions pictures;
  OutputPaths outputs;
  sillon::Placing placing = sillon::Placing::AsGiven;
  int threads = 1;
  bool quiet = false;
};

/// \return InvalidArgument with one sentence, or the arguments.
sillon::Result<Arguments> readArguments(int argc, const char* const* argv);

}  // namespace cli
