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

/// \param shape  outlives what is returned.
InsideCells insideOf(const Shape& shape);

/// The light under which pictures were solved for.
struct SolvedLight {
  Roughness roughness;
  double level = 1;  ///< SolvedDirections::level
};

/// Each picture as the directions alone show it, on another raster. Tones that pictures take from each other are
/// missing from it: no correction brings them back.
std::vector<Tones> shownTones(std::span<const ShownPicture> shown, const DirectionMap& directions,
                              const SolvedLight& light, int width, int height);

// Tones that a plate leaves out of a picture, asked for on top of it.

/// Adds a share of what is missing to the tones that are asked for next. \param light  seen, in the cells of `asked`;
/// negative: no plate. \param level  light of white. \param next  any size, stretched over the same page.
void addMissingTones(std::span<const float> light, const Tones& asked, const Lobe& lobe, double level, Tones& next);

// The lamp of a single picture, where none is given.

/// The azimuth, of three that force few beads to end, whose plate shows the picture best [degrees]: forced ends say
/// little of what they spoil. Plates for this have the usual settings and as many beads on any page, so that whoever
/// changes a setting keeps the lamp. \param lit  one picture. \return the errors of solveDirections and seePlate.
Result<double> chosenAzimuth(std::vector<LitPicture> lit, const Roughness& roughness, const Shape& shape,
                             const InversionParams& inversion, const RunContext& run, const OnTrial& onTrial);

}  // namespace sillon
