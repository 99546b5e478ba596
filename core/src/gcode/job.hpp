// A print, planned and checked before the first byte is written.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gcode/motion.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// A job that is ready to be written, and the heights of its layers.

inline constexpr double kLeastBead = 0.6;   ///< [nozzle], thinner beads tear
inline constexpr double kWidestBead = 1.6;  ///< [nozzle], wider beads do not reach their sides

constexpr double kParkLift = 10;  ///< [mm], above the finished plate, before the end block

/// The highest place above the bed that the printer reaches: its Z is there maxZ [mm].
inline double highest(const Printer& printer) { return printer.maxZ - printer.zOffset; }

/// Above clips and screws of the bed, and above what stands there: no travel to or from its edge is lower [mm].
inline double safeHeight(const Printer& printer, const PrintParams& params) {
  return std::min(params.startHeight + 10, highest(printer));
}

/// What a patch prints, and how: sillon/gcode/patches.hpp.
struct PlacedPatch {
  Patch how;  ///< its lines are `paths`
  std::vector<BeadPath> paths;
};

/// A job that is known to be printable, on the bed [µm].
struct GcodeJob {
  BeadPath purge;                              ///< before the first layer; without points where there is none
  double purgeHeight = 0;                      ///< [mm]
  PointUm aside;                               ///< off the plates: where the nozzle waits for heat
  std::vector<BeadPath> skirt;                 ///< layer on the bed only
  std::vector<BeadPath> brim;                  ///< first layer of each copy
  std::vector<BeadPath> firstBase;             ///< the first layer, where it is a base layer
  std::array<std::vector<BeadPath>, 2> bases;  ///< of the other base layers, taking turns
  std::vector<BeadPath> across;                ///< of the base layer next to the cycles; empty where it is as others
  std::vector<BeadPath> bedAcross;             ///< next to the bed's cycles, likewise; ShowSide::Both
  std::vector<BeadPath> cycles;                ///< of oriented layers, widths within 0.6..1.6 nozzle
  std::vector<std::vector<BeadPath>> rim;      ///< of each layer above the oriented ones: the loops of each border
  std::vector<BeadPath> bedCycles;             ///< of oriented layers below the base, mirrored; ShowSide::Both
  std::vector<PointUm> copies{{}};             ///< where each plate stands, from the first
  std::vector<PlacedPatch> patches;            ///< instead of cycles, on the layers above the base
  double spacing = 0;                          ///< of the toolpath [mm]
  Vec2 plate;                                  ///< size of the shape [mm]
  double clampedMm = 0;                        ///< length with a width held at a limit, per oriented layer
  double fillRatio = 0;                        ///< bead area over shape area, per oriented layer
  bool knowsAdvance = false;                   ///< something sets pressure advance: turns may be slower than straights
  double showSpeed = 0;                        ///< of oriented layers [mm/s]
  Bounds firstPlate;                           ///< the first copy with its brim, on the bed [mm]
  bool ownStart = false;                       ///< the start block is ours, and leaves the nozzle where it homes
  bool hotStart = false;                       ///< the start block leaves the nozzle hot: what is in it drips
  double startRetracted = 0;                   ///< filament that the start block draws back and leaves so [mm]
  std::vector<int> otherHotTools;              ///< that the start block heats, beside the one that prints
  bool hotChamber = false;                     ///< the start block heats it
  double startFlow = 100;                      ///< by M221 of the start block [%], for the whole print
  std::string startBlock;                      ///< values put in
  std::string endBlock;
  std::vector<Warning> warnings;

  void warn(WarningCode code, std::vector<NamedValue> values = {}) { warnings.push_back({code, std::move(values)}); }
};

/// A share as warnings tell it, to a tenth.
inline double percent(double share) { return std::round(1000 * share) / 10; }

/// Cross-section of filament [mm²].
inline double filamentArea(double diameter) { return 3.14159265358979323846 * diameter * diameter / 4; }

/// Whether the first layer lies on the bed and not on a print that stands there: only then is it a special one.
inline bool beginsOnBed(const PrintParams& params) { return !(params.startHeight > 0); }

/// Height of the first layer, which has a default [mm].
inline double firstLayerHeight(const PrintParams& params) {
  return params.firstLayerHeight > 0 && beginsOnBed(params) ? params.firstLayerHeight : params.layerHeight;
}

/// Layers of one plate that lie below its rim.
inline int layersBelowRim(const PrintParams& params) {
  return params.base + params.layers * (params.showSide == ShowSide::Both ? 2 : 1);
}

/// Number of layers of one plate.
inline int layerCount(const PrintParams& params) { return layersBelowRim(params) + params.rim; }

/// Number of layers of all plates in the file.
inline int fileLayers(const GcodeJob& job, const PrintParams& params) {
  return layerCount(params) * static_cast<int>(job.copies.size());
}

/// Whether a layer, counted from 0, is an oriented one.
inline bool isOriented(const PrintParams& params, int layer) {
  const bool onBed = params.showSide != ShowSide::Up && layer < params.layers;
  const int below = params.showSide == ShowSide::Up ? params.base : params.layers + params.base;
  return onBed || (layer >= below && layer < layersBelowRim(params));
}

/// What a base layer lies next to.
enum class NextTo { Base, Oriented, OrientedOnBed };

/// \param turn  of the base layer among its kind, from the lowest. One between two oriented layers is next to the
/// upper.
inline NextTo nextTo(const PrintParams& params, int turn) {
  if (turn == params.base - 1 && params.showSide != ShowSide::Bed) return NextTo::Oriented;
  if (turn == 0 && params.showSide == ShowSide::Bed) return NextTo::Oriented;
  return turn == 0 && params.showSide == ShowSide::Both ? NextTo::OrientedOnBed : NextTo::Base;
}

/// Top of a layer, counted from 0 [mm].
inline double layerTop(const PrintParams& params, int layer) {
  return params.startHeight + firstLayerHeight(params) + layer * params.layerHeight;
}

// The part of G-code export that can fail: it checks everything, and lays out what will be written.

/// \param across  null where needsAcross does not ask for it. \return InvalidArgument, DoesNotFit or EmptyShape, as
/// writeGcode.
Result<GcodeJob> prepareGcodeJob(const Toolpath& toolpath, const Toolpath* across, const Shape& shape,
                                 const Printer& printer, const PrintParams& params);

/// \return InvalidArgument, DoesNotFit or EmptyShape, as writePatches.
Result<GcodeJob> preparePatchJob(const PatchPlate& plate, const Printer& printer, const PrintParams& params);

// Ranges of everything G-code export is given.

/// Checks all that can be judged number by number, before anything is placed: text, ranges, finite coordinates and
/// widths. \return the first fault: InvalidArgument, DoesNotFit (in height) or EmptyShape (no cycles). \param across
/// read where needsAcross, and missing there if null.
std::optional<Error> checkGcodeInput(const Toolpath& toolpath, const Toolpath* across, const Shape& shape,
                                     const Printer& printer, const PrintParams& params);

/// The same for patches. \return InvalidArgument, DoesNotFit or EmptyShape (no lines).
std::optional<Error> checkPatchInput(const PatchPlate& plate, const Printer& printer, const PrintParams& params);

/// The part of it that needs no toolpath.
std::optional<Error> checkPlateInput(const Shape& shape, const Printer& printer, const PrintParams& params);

}  // namespace sillon
