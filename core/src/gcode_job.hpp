// The part of G-code export that can fail: checks, placement on the bed, and the paths besides the toolpath.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "motion.hpp"
#include "sillon/gcode.hpp"

namespace sillon {

/// A job that is known to be printable, on the bed [µm].
struct GcodeJob {
  std::vector<BeadPath> skirt;                   ///< first layer only; a purge line where no skirt fits
  std::array<std::vector<BeadPath>, 2> hatches;  ///< of base layers, taking turns
  std::vector<BeadPath> cycles;                  ///< of oriented layers, widths within 0.6..1.6 nozzle
  double spacing = 0;                            ///< of the toolpath [mm]
  Vec2 plate;                                    ///< size of the shape [mm]
  double clampedMm = 0;                          ///< length with a width held at a limit, per oriented layer
  double fillRatio = 0;                          ///< bead area over shape area, per oriented layer
  std::string startBlock;                        ///< the user's, values put in; empty: ours
  std::string endBlock;
  std::vector<std::string> warnings;
};

/// \return InvalidArgument, DoesNotFit or EmptyShape, as writeGcode.
Result<GcodeJob> prepareGcodeJob(const Toolpath& toolpath, const Shape& shape, const Printer& printer,
                                 const PrintParams& params);

/// Height of the first layer, which has a default [mm].
inline double firstLayerHeight(const PrintParams& params) {
  return params.firstLayerHeight > 0 ? params.firstLayerHeight : params.layerHeight;
}

/// Top of a layer, counted from 0 [mm].
inline double layerTop(const PrintParams& params, int layer) {
  return firstLayerHeight(params) + layer * params.layerHeight;
}

}  // namespace sillon
