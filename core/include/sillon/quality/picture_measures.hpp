// How well a toolpath shows the pictures it was made for, each under its lamp. Definitions: docs/reference/metrics.md.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/look/inversion.hpp"

namespace sillon {

struct PictureMeasures {
  double r = 0;         ///< Pearson's, of what is seen and the picture, both as sRGB codes of cells of 2 tau; 0: flat
  double ssim = 0;      ///< of the same after the best affine fit, Gaussian window of 1.5 cells
  double contrast = 1;  ///< light at the 99th percentile of the cells by that at the 1st
  std::vector<double> others;  ///< r with each picture under this lamp, in order; its own r at its own place
};

/// How much of one picture a plate shows: r with what was asked for, -1..1.
struct PictureFacts {
  bool oneTone = false;  ///< nothing can be seen in it, whatever its r
  double fieldR = 1;     ///< of what the directions alone show; 1: the plate has no other picture
  double seenR = 1;      ///< of what the beads show; 1: not measured
};

/// What a plate shows under each lamp, in cells of about 2 tau.
struct SeenCells {
  int width = 0;
  int height = 0;
  std::vector<std::vector<float>> light;  ///< per lamp, row 0 on top; negative where there is no plate
};

/// Light is lightOf of the nearest bead at points tau/4 apart, averaged over each cell; cells less than half covered
/// are no plate. \param page  [mm]. \return InvalidArgument, TooLarge (more than 100 million points) or Cancelled.
Result<SeenCells> seePlate(const Toolpath& toolpath, Vec2 page, std::span<const Lamp> lamps, const Roughness& roughness,
                           const RunContext& run);

/// One row per picture, of what seePlate sees. \return as seePlate.
Result<std::vector<PictureMeasures>> measurePictures(const Toolpath& toolpath, Vec2 page,
                                                     std::span<const ShownPicture> pictures, const Roughness& roughness,
                                                     const RunContext& run);

/// The same of light that is known: rows of cells, row 0 on top, negative where there is no plate. As of no plate where
/// there are not as many cells as the picture has.
PictureMeasures compareTones(std::span<const float> light, const Tones& picture);

}  // namespace sillon
