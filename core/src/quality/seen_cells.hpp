// Renders a plate as cells of light, and measures its likeness to pictures (docs/reference/metrics.md).
#pragma once

#include <span>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {

/// Light of a plate under each lamp, in cells of about 2 tau.
struct SeenCells {
  int width = 0;
  int height = 0;
  /// Light per lamp and cell, row 0 on top; negative where there is no plate
  std::vector<std::vector<float>> light;
};

/// Renders a plate as cells of light, one raster per lamp. Light is lightOf of the nearest bead at
/// points tau/4 apart, averaged over each cell; cells less than half covered are no plate.
/// \param page  size [mm].
/// \return InvalidArgument, TooLarge (more than 100 million points) or Cancelled.
Result<SeenCells> seePlate(const Toolpath& toolpath, Vec2 page, std::span<const Lamp> lamps, const Roughness& roughness,
                           const RunContext& run);

/// Measures each picture by light that is known.
/// \param lights  light per picture, in `width` by `height` cells, row 0 on top, negative where
/// there is no plate.
std::vector<PictureMeasures> comparePictures(const std::vector<std::vector<float>>& lights,
                                             std::span<const ShownPicture> pictures, int width, int height);

/// Compares known light with one picture.
/// \param light  rows of cells, row 0 on top, negative where there is no plate. Without as many
/// cells as the picture has, nothing is seen.
PictureMeasures compareTones(std::span<const float> light, const Tones& picture);

}  // namespace sillon
