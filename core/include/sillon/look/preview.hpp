// Renders pictures of plates: previews, and the thumbnails of printers' screens.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Pictures of a toolpath: beads coloured by direction with a legend, and their look under one
// light.

/// Conditions under which the look is drawn: a lamp, a spool and an eye.
struct LookParams {
  Lamp lamp{60, 35, 0.1};
  std::array<std::uint8_t, 3> colour{24, 78, 168};  ///< colour of the body, sRGB; blue PLA
  Roughness roughness{2.36, 17.32};
  /// Height of the eye above the plate's middle, in lengths of its longer side, 0.1..1000; 0: far
  /// away
  double eyeDistance = 2.4;
};

/// Size and look of a preview.
struct PreviewParams {
  /// Width of one panel with its margins [pixels], 16..16384; the height follows the page
  int width = 1600;
  LookParams look;
};

/// Renders both panels side by side or stacked, whichever is nearer to 4:3: directions with legend,
/// then the look by the model of appearance.hpp, exposed for its brightest direction.
/// \param page  size [mm].
/// \return InvalidArgument, TooLarge (beyond 32768 pixels per side or 100 million in all) or
/// Cancelled.
Result<RgbImage> renderPreview(const Toolpath& toolpath, Vec2 page, const PreviewParams& params,
                               const RunContext& run);

/// Renders the look alone, with the page as large as fits with a margin, on the preview's dark
/// ground.
/// \param width,  height  size [pixels], 16..1024.
/// \return the errors of renderPreview.
Result<RgbImage> renderLook(const Toolpath& toolpath, Vec2 page, int width, int height,
                            const LookParams& look, const RunContext& run);

// The look of a plate for the printer's screen.

/// Renders the pictures for PrintParams::thumbnails.
/// \param screenSizes  text that readThumbnailSizes reads.
/// \param page  size [mm].
/// \return the errors of readThumbnailSizes and renderLook.
Result<std::vector<Thumbnail>> lookThumbnails(const Toolpath& toolpath, Vec2 page,
                                              std::string_view screenSizes, const LookParams& look,
                                              const RunContext& run);

// The finished plate as a small picture of directions, from which web pages draw its shimmer:
// docs/reference/view.md.

/// The filament that the plate is shown in.
struct ViewParams {
  std::array<std::uint8_t, 3> colour{201, 148, 46};  ///< colour of the body, sRGB; gold PLA
  Roughness roughness;
};

/// Makes a PNG of at most 200 KiB: per texel the beads' mean direction, the share that is covered,
/// and the beads' mean width.
/// \param page  size [mm], 0.001..100000 per side.
/// \return the same bytes for the same toolpath; InvalidArgument, TooLarge.
Result<std::vector<std::uint8_t>> viewFile(const Toolpath& toolpath, Vec2 page,
                                           const ViewParams& params);

// The loop of moving light that people send to one another: the position of the lamp in each of its
// frames.

/// One frame of the loop.
struct LoopFrame {
  Lamp lamp;
  int milliseconds = 0;  ///< time for which it is shown
};

/// Makes the frames of a loop. One lamp goes round once; several are held in turn, with a quick way
/// to the next. The last frame leads to the first.
/// \param lamps  lamps of the plate's pictures; not empty.
std::vector<LoopFrame> loopFrames(std::span<const Lamp> lamps);

/// Returns the usual longer side of a loop that is sent [pixels].
int loopSide();
/// Returns the most bytes of a loop that messengers take well.
int loopBytes();

/// Lists the qualities of lossy pictures that are tried until the loop is small enough, best first,
/// 0..100.
std::vector<int> loopQualities();

}  // namespace sillon
