// From the pictures that a project names to the directions that show them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/project/project.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {

/// The pictures of the lowest layer as solved for. All lists have one entry per picture.
struct PlatePictures {
  std::vector<ShownPicture> shown;
  std::vector<Tones> solved;    ///< what was solved for: with what plates before left out on top
  std::vector<bool> chosen;     ///< whether its lamp was
  std::vector<double> leftOut;  ///< share of it that sticks out of the page, 0..1
  Roughness roughness;          ///< of the spool, on the side that is seen
  double level = 1;             ///< SolvedDirections::level
  double contrast = 1;          ///< of the first lamp's brightest and darkest direction
  /// Correlation of each picture with what the directions alone show; beads only lower it
  std::vector<double> fieldR;
};

/// The last result of solvePictures, and what it had been asked for.
struct KeptPictures {
  std::vector<LitPicture> lit;
  Shape shape;
  double spacing = 0;
  InversionParams inversion;
  PlatePictures pictures;
  DirectionMap directions;
};

/// Slopes of the project's spool as its nozzle prints it, on the side that is seen.
Roughness roughnessOf(const Project& project);

/// Pictures under their lamps, without tones; a lamp that is not given is to be chosen, as high as
/// the first.
/// \param lampSize  PictureParams::lampSize.
std::vector<LitPicture> unlit(const std::vector<LampPicture>& pictures, double lampSize);

/// Tells how well a plate shows each picture.
/// \param measures  of each, or empty: not measured.
std::vector<PictureFacts> pictureFacts(const PlatePictures& pictures,
                                       const std::vector<PictureMeasures>& measures);

/// How the pictures are solved for.
InversionParams inversionOf(const PictureParams& params);

/// Called before each plate that is made to choose a lamp.
/// \param trial  0, 1, ... of `trials`.
using OnTrial = std::function<void(int trial, int trials)>;

/// Reads the pictures of the lowest layer and puts the directions that show them into the input. If
/// it has none, nothing is read and none are shown. The lamp of a single picture that is left open
/// is the one of three whose plate, made with the usual toolpath settings, shows it best. \param
/// kept  of the plate before, as while somebody edits: what is asked for once more is taken from
/// there; none after pictures of more than 4 million pixels. \return what reading, decodeImage and
/// solveDirections return.
Result<PlatePictures> solvePictures(const Project& project, const ReadInput& read,
                                    PlateInput& input, const RunContext& run,
                                    std::optional<KeptPictures>* kept = nullptr,
                                    const OnTrial& onTrial = {});

/// The view of previews and thumbnails.
/// \param picture  under whose lamp, from far above, as it was solved for; beyond the pictures:
/// under the preview's own lamp.
LookParams lookOf(const Project& project, const PlatePictures& pictures, std::size_t picture);

}  // namespace sillon
