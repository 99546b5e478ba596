// sillon rebrush: other beads on the top of a sliced file.
#pragma once

#include <string>

#include "files.hpp"
#include "pictures.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace CLI {
class App;
}

namespace cli {

struct RebrushArguments {
  std::string file;
  std::string out;  ///< empty: in place
  std::string report;
  std::string preview;      ///< PNG of each replaced surface
  int previewWidth = 1600;  ///< of each panel [pixels]
  bool list = false;
  bool json = false;
  double angle = 0;  ///< [degrees]
  std::string directions;
  sillon::DirectionEncoding encoding = sillon::DirectionEncoding::Angle;
  std::string modes;  ///< a word, or a picture's name
  PictureOptions pictures;
  bool perimeters = false;  ///< given
  sillon::RebrushOptions options;
  int threads = 1;
};

/// Adds the command with its options.
void addRebrush(CLI::App& app, RebrushArguments& arguments);

sillon::Result<Outcome> runRebrush(const RebrushArguments& arguments, const sillon::RunContext& run);

}  // namespace cli
