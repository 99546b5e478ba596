// Pictures that a plate shows, each under its lamp: their options, and their lines of the summary.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"
#include "sillon/base/result.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/project/project.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon::cli {

/// Options as given; lamps belong to pictures in order.
struct PictureOptions {
  std::vector<std::string> files;
  std::vector<std::string> lamps;       ///< "AZ" or "AZ,EL"; if fewer than files, the other lamps are chosen
  std::optional<std::string> lampSize;  ///< "bulb", "softbox", "window" or a slope
  std::optional<std::string> spool;
  std::string spoolsFile;        ///< file of the user's own spools; empty if none
  std::vector<Spool> ownSpools;  ///< contents of spoolsFile, once it is read
  std::optional<std::string> proportions;
  std::optional<double> smoothness;
  std::optional<double> localContrast;
};

/// Adds the options. \param options  must have --directions and --angle already, which --picture excludes.
void addPictures(Options& options, PictureOptions& pictures);

/// Parses a size of lamps: "bulb", "softbox", "window" or a slope from 0 to 2. \return nothing for any other text.
std::optional<double> lampSlopeOf(const std::string& text);

/// Returns the names of sizes of lamps, with their slopes.
std::array<std::pair<const char*, double>, 3> lampSizes();
/// Returns "bulb, softbox, window or a slope from 0 to 2".
std::string lampSizeRange();

/// Adds --spool and --spools alone.
void addSpools(Options& options, PictureOptions& pictures);

/// Reads the file of own spools, if one is named. \return its error, or nothing.
std::optional<Error> readOwnSpools(PictureOptions& options);

/// Returns the own spool that is chosen; null if none is, or if the chosen one comes with the program.
const Spool* ownSpool(const PictureOptions& options);

/// Applies the options to a project: pictures replace its own and its directions; lamps alone move those of its own
/// pictures.
/// \return an error, or an empty string.
std::string applyPictures(const PictureOptions& options, Project& project);

/// Tells whether a file is a picture, not a scene, by its name or its first bytes.
bool looksLikePicture(const std::string& path);

/// Returns the look of the preview: that of sillon::lookOf(), but under the first given lamp if there is no picture.
LookParams previewLook(const PictureOptions& options, const Project& project, const PlatePictures& pictures,
                       std::size_t picture);

/// Returns a note on a picture of which this share is cut off; empty if the share is small.
std::string cutOffNote(double leftOut);

/// Returns the lines of the summary about a plate's pictures.
std::string pictureLines(const Plate& plate);

}  // namespace sillon::cli
