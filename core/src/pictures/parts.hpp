// Steps of solving pictures.
#pragma once

#include <span>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/pictures/pictures.hpp"

namespace sillon {

// Shapes and shown tones on rasters of the page.

/// Returns a function that rasters a shape; it yields no cells if all or none lie inside. \param shape  must outlive
/// the function.
InsideCells insideOf(const Shape& shape);

/// The light for which pictures were solved.
struct SolvedLight {
  Roughness roughness;
  double level = 1;  ///< SolvedDirections::level
};

/// Resamples each picture as the directions alone show it to another raster. It lacks the tones that pictures take from
/// each other, which no correction can restore.
std::vector<Tones> shownTones(std::span<const ShownPicture> shown, const DirectionMap& directions,
                              const SolvedLight& light, int width, int height);

// Tones that a plate misses in a picture, requested in addition to it.

/// Adds a share of the missing tones to the tones requested next. \param light  light seen in the cells of `asked`;
/// negative: no plate. \param level  light of white. \param next  tones of any size, stretched over the same page.
void addMissingTones(std::span<const float> light, const Tones& asked, const Lobe& lobe, double level, Tones& next);

// The lamp of a single picture, if none is given.

/// Chooses the azimuth of a lamp [degrees]: among three that force few beads to end, the one whose trial plate shows
/// the picture best, because the number of forced ends says little about the damage. Trial plates have the default
/// settings and the same number of beads on any page, so that changing a setting keeps the lamp. \param lit  one
/// picture. \return the errors of solveDirections and seePlate.
Result<double> chosenAzimuth(std::vector<LitPicture> lit, const Roughness& roughness, const Shape& shape,
                             const InversionParams& inversion, const RunContext& run, const OnTrial& onTrial);

/// Lists pictures under their lamps, without tones. A lamp that is not given is to be chosen, at
/// the elevation of the first.
/// \param lampSize  PictureParams::lampSize.
std::vector<LitPicture> unlit(const std::vector<LampPicture>& pictures, double lampSize);

/// Tells how well a plate shows each picture.
/// \param measures  measures of each picture, or empty: not measured.
std::vector<PictureFacts> pictureFacts(const PlatePictures& pictures, const std::vector<PictureMeasures>& measures);

/// Returns the inversion's parameters for the settings of pictures.
InversionParams inversionOf(const PictureParams& params);

/// Reads the pictures of the lowest layer and puts the directions that show them into the input. If
/// the layer has none, nothing is read and none are shown. If the lamp of a single picture is left
/// open, it becomes the one of three whose plate, made with the usual toolpath settings, shows the
/// picture best.
/// \param kept  result of the plate before, as while somebody edits: what is asked for once more is
/// taken from there. It is emptied after pictures of more than 4 million pixels.
/// \return the errors of reading, decodeImage and solveDirections.
Result<PlatePictures> solvePictures(const Project& project, const ReadInput& read, PlateInput& input,
                                    const RunContext& run, std::optional<KeptPictures>* kept = nullptr,
                                    const OnTrial& onTrial = {});

}  // namespace sillon
