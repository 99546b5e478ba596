// Finds the directions that show the pictures which a project names.
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
  std::vector<Tones> solved;    ///< tones solved for: `shown` plus what earlier plates left out
  std::vector<bool> chosen;     ///< true where the solver chose the lamp
  std::vector<double> leftOut;  ///< share of the picture that sticks out of the page, 0..1
  Roughness roughness;          ///< roughness of the spool, on the side that is seen
  double level = 1;             ///< SolvedDirections::level
  double contrast = 1;  ///< contrast between the first lamp's brightest and darkest direction
  /// Correlation of each of several pictures with what the directions alone show; beads only lower
  /// it
  std::vector<double> fieldR;
};

/// The last result of solvePictures, and the request that it answers.
struct KeptPictures {
  std::vector<LitPicture> lit;
  Shape shape;
  double spacing = 0;
  InversionParams inversion;
  PlatePictures pictures;
  DirectionMap directions;
};

/// Returns the slopes of the project's spool as its nozzle prints it, on the side that is seen.
Roughness roughnessOf(const Project& project);

/// Called before each plate that is made to choose a lamp.
/// \param trial  number of the plate: 0, 1, ... of `trials`.
using OnTrial = std::function<void(int trial, int trials)>;

/// Returns the view of previews and thumbnails.
/// \param picture  index of the picture under whose lamp the plate is seen, from far above, as it
/// was solved for; beyond the pictures: the preview's own lamp.
LookParams lookOf(const Project& project, const PlatePictures& pictures, std::size_t picture);

}  // namespace sillon
