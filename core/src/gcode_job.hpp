// The part of G-code export that can fail: checks, placement on the bed, and the paths besides the toolpath.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "motion.hpp"
#include "sillon/gcode.hpp"

namespace sillon {

inline constexpr double kLeastBead = 0.6;  ///< [nozzle], thinner beads tear

constexpr double kParkLift = 10;  ///< [mm], above the finished plate, before the end block

/// A job that is known to be printable, on the bed [µm].
struct GcodeJob {
  std::vector<BeadPath> skirt;                 ///< layer on the bed only; a purge line where no skirt fits
  std::vector<BeadPath> brim;                  ///< first layer of each copy
  std::vector<BeadPath> firstBase;             ///< the first layer, where it is a base layer
  std::array<std::vector<BeadPath>, 2> bases;  ///< of the other base layers, taking turns
  std::vector<BeadPath> cycles;                ///< of oriented layers, widths within 0.6..1.6 nozzle
  std::vector<BeadPath> bedCycles;             ///< of oriented layers below the base, mirrored; ShowSide::Both
  std::vector<PointUm> copies{{}};             ///< where each plate stands, from the first
  double spacing = 0;                          ///< of the toolpath [mm]
  Vec2 plate;                                  ///< size of the shape [mm]
  double clampedMm = 0;                        ///< length with a width held at a limit, per oriented layer
  double fillRatio = 0;                        ///< bead area over shape area, per oriented layer
  std::string startBlock;                      ///< the user's, values put in; empty: ours
  std::string endBlock;
  std::vector<std::string> warnings;
};

/// \return InvalidArgument, DoesNotFit or EmptyShape, as writeGcode.
Result<GcodeJob> prepareGcodeJob(const Toolpath& toolpath, const Shape& shape, const Printer& printer,
                                 const PrintParams& params);

/// Where the first page's origin lies on the bed, on the grid of the file, so that the path keeps its own rounding.
/// \param box  around the turned shape.
PointUm placement(const Bounds& box, const Printer& printer, const PrintParams& params);

/// Where each plate stands, from the first: row by row, every second one backwards, for short ways over what is done.
std::vector<PointUm> copyPlaces(const Bounds& box, const Printer& printer, const PrintParams& params);

/// Whether the first layer lies on the bed and not on a print that stands there: only then is it a special one.
inline bool beginsOnBed(const PrintParams& params) { return !(params.startHeight > 0); }

/// Height of the first layer, which has a default [mm].
inline double firstLayerHeight(const PrintParams& params) {
  return params.firstLayerHeight > 0 && beginsOnBed(params) ? params.firstLayerHeight : params.layerHeight;
}

/// Of one plate.
inline int layerCount(const PrintParams& params) {
  return params.base + params.layers * (params.showSide == ShowSide::Both ? 2 : 1);
}

/// Whether a layer, counted from 0, is an oriented one.
inline bool isOriented(const PrintParams& params, int layer) {
  const bool onBed = params.showSide != ShowSide::Up && layer < params.layers;
  const int below = params.showSide == ShowSide::Up ? params.base : params.layers + params.base;
  return onBed || layer >= below;
}

/// Top of a layer, counted from 0 [mm].
inline double layerTop(const PrintParams& params, int layer) {
  return params.startHeight + firstLayerHeight(params) + layer * params.layerHeight;
}

}  // namespace sillon
