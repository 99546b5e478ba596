// Pictures that a plate is to show, each under its lamp: their options, and lines of the summary about them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"
#include "sillon/base/result.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/project/project.hpp"
#include "sillon/quality/metrics.hpp"

namespace cli {

/// The options as given: the first lamp is the first picture's.
struct PictureOptions {
  std::vector<std::string> files;
  std::vector<std::string> lamps;       ///< "AZ" or "AZ,EL"; fewer than files: the rest is chosen
  std::optional<std::string> lampSize;  ///< "bulb", "softbox", "window" or a slope
  std::optional<std::string> spool;
  std::string spoolsFile;                ///< of a person's own; empty: none
  std::vector<sillon::Spool> ownSpools;  ///< what is in it, once it is read
  std::optional<std::string> proportions;
  std::optional<double> smoothness;
  std::optional<double> localContrast;
};

/// Adds the options. \param options  have --directions and --angle already, which they exclude.
void addPictures(Options& options, PictureOptions& pictures);

/// "bulb", "softbox", "window" or a slope from 0 to 2. \return nothing for any other text.
std::optional<double> lampSlopeOf(const std::string& text);

/// The names of sizes of lamps, and their slopes.
std::array<std::pair<const char*, double>, 3> lampSizes();
/// "bulb, softbox, window or a slope from 0 to 2"
std::string lampSizeRange();

/// Adds --spool and --spools alone.
void addSpools(Options& options, PictureOptions& pictures);

/// Reads the file of own spools, if one is named. \return what is wrong with it.
std::optional<sillon::Error> readOwnSpools(PictureOptions& options);

/// The own spool that is asked for; null if none is, or one that comes with the program.
const sillon::Spool* ownSpool(const PictureOptions& options);

/// Lays the options over a project: pictures replace its own and its directions, lamps alone move its own pictures'.
/// \return what is wrong; empty: nothing.
std::string applyPictures(const PictureOptions& options, sillon::Project& project);

/// Tells whether a file is a picture, by its name or by how it begins, and not a scene.
bool looksLikePicture(const std::string& path);

/// How the preview looks at the plate: as lookOf, but under the first lamp that was given, where there is no picture.
sillon::LookParams previewLook(const PictureOptions& options, const sillon::Project& project,
                               const sillon::PlatePictures& pictures, std::size_t picture);

/// A note on a picture of which this share is cut off; empty where that is little.
std::string cutOffNote(double leftOut);

/// Lines of the summary about a plate's pictures.
std::string pictureLines(const sillon::Plate& plate);

}  // namespace cli
