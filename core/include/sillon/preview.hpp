// Pictures of a toolpath: beads coloured by direction with a legend, and their look under one light.
#pragma once

#include <cstdint>
#include <vector>

#include "sillon/result.hpp"
#include "sillon/run_context.hpp"
#include "sillon/types.hpp"

namespace sillon {

struct PreviewParams {
  int width = 1600;            ///< of one panel with its margins [pixels], 16..16384; the height follows the page
  double lightAzimuth = 60;    ///< of the light in the look panel, degrees counter-clockwise from +x
  double lightElevation = 35;  ///< degrees above the plate, 1..90
};

struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< row 0 on top
};

/// Both panels side by side or stacked, whichever is nearer to 4:3: directions with legend, then the look: an
/// anisotropic microfacet lobe (Beckmann) along each bead plus the bead's round profile, made for the eye.
/// \param page  [mm].
/// \return InvalidArgument, TooLarge (beyond 32768 pixels per side or 100 million in all) or Cancelled.
Result<RgbImage> renderPreview(const Toolpath& toolpath, Vec2 page, const PreviewParams& params, const RunContext& run);

/// The look alone, the page as large as fits with a margin, on the preview's dark ground.
/// \param width, height  [pixels], 16..1024.
/// \return as renderPreview.
Result<RgbImage> renderLook(const Toolpath& toolpath, Vec2 page, int width, int height, const RunContext& run);

}  // namespace sillon
