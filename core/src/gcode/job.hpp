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

/// Turns a warning into an error, for faults that are refused.
Error refusalOf(const Warning& warning);

// The job that is ready to be written, and the heights of its layers.

inline constexpr double kLeastBead = 0.6;   ///< [nozzle]; thinner beads tear
inline constexpr double kWidestBead = 1.6;  ///< [nozzle]; the plastic of wider beads does not reach their sides

constexpr double kParkLift = 10;  ///< lift above the finished plate before the end block [mm]

/// Height above the bed that the printer reaches at most [mm]; its own Z reads maxZ there.
inline double highest(const Printer& printer) { return printer.maxZ - printer.zOffset; }

/// Height of travels to and from the bed's edge [mm]: it clears clips and screws, and a print that stands there.
inline double safeHeight(const Printer& printer, const PrintParams& params) {
  return std::min(params.startHeight + 10, highest(printer));
}

/// A patch (sillon/gcode/writer.hpp) whose lines have been placed on the bed.
struct PlacedPatch {
  Patch how;  ///< settings of the patch; `paths` replace its lines
  std::vector<BeadPath> paths;
};

/// A job that has passed every check; its points lie on the bed [µm].
struct GcodeJob {
  BeadPath purge;                              ///< purge line before the first layer; no points: no purge
  double purgeHeight = 0;                      ///< height of the purge line [mm]
  PointUm aside;                               ///< place off the plates where the nozzle waits for heat
  std::vector<BeadPath> skirt;                 ///< loops around all plates, in the layer on the bed
  std::vector<BeadPath> brim;                  ///< loops around each copy, in its first layer
  std::vector<BeadPath> firstBase;             ///< the first layer, if it is a base layer smaller than the others
  std::array<std::vector<BeadPath>, 2> bases;  ///< the other base layers, in turns
  std::vector<BeadPath> across;                ///< the base layer next to the cycles; empty if it is like the others
  std::vector<BeadPath> bedAcross;             ///< the base layer next to bedCycles, likewise; ShowSide::Both
  std::vector<BeadPath> cycles;                ///< an oriented layer; widths 0.6..1.6 nozzle
  std::vector<std::vector<BeadPath>> rim;      ///< loops of each border, for every layer above the oriented ones
  std::vector<BeadPath> bedCycles;             ///< an oriented layer below the base, mirrored; ShowSide::Both
  std::vector<PointUm> copies{{}};             ///< offset of each plate from the first one
  std::vector<PlacedPatch> patches;            ///< patches that replace the cycles above the base
  double spacing = 0;                          ///< spacing of the toolpath [mm]
  Vec2 plate;                                  ///< size of the shape [mm]
  double clampedMm = 0;                        ///< length whose width is held at a limit, per oriented layer
  double fillRatio = 0;                        ///< bead area over shape area, per oriented layer
  bool knowsAdvance = false;       ///< pressure advance is set somewhere, so turns may be slower than straights
  double showSpeed = 0;            ///< speed of oriented layers [mm/s]
  Bounds firstPlate;               ///< the first copy with its brim, on the bed [mm]
  bool ownStart = false;           ///< the start block is Sillon's own, and leaves the nozzle where it homes
  bool hotStart = false;           ///< the start block leaves the nozzle hot, so that it drips
  double startRetracted = 0;       ///< filament that the start block leaves drawn back [mm]
  std::vector<int> otherHotTools;  ///< other tools that the start block heats
  bool hotChamber = false;         ///< the start block heats the chamber
  double startFlow = 100;          ///< flow that M221 in the start block sets for the whole print [%]
  std::string startBlock;          ///< the block with its placeholders replaced
  std::string endBlock;
  std::vector<Warning> warnings;

  void warn(WarningCode code, std::vector<NamedValue> values = {}) { warnings.push_back({code, std::move(values)}); }
};

/// A share as a percentage for warnings, to a tenth.
inline double percent(double share) { return std::round(1000 * share) / 10; }

/// Cross-section of filament [mm²].
inline double filamentArea(double diameter) { return 3.14159265358979323846 * diameter * diameter / 4; }

/// Tells whether the first layer lies on the bed and not on a print that stands there. Only then is it special: slower,
/// hotter, without fan.
inline bool beginsOnBed(const PrintParams& params) { return !(params.startHeight > 0); }

/// Height of the first layer [mm]; layerHeight where none of its own is set.
inline double firstLayerHeight(const PrintParams& params) {
  return params.firstLayerHeight > 0 && beginsOnBed(params) ? params.firstLayerHeight : params.layerHeight;
}

/// Number of layers of one plate that lie below its rim.
inline int layersBelowRim(const PrintParams& params) {
  return params.base + params.layers * (params.showSide == ShowSide::Both ? 2 : 1);
}

/// Number of layers of one plate.
inline int layerCount(const PrintParams& params) { return layersBelowRim(params) + params.rim; }

/// Number of layers of all plates in the file.
inline int fileLayers(const GcodeJob& job, const PrintParams& params) {
  return layerCount(params) * static_cast<int>(job.copies.size());
}

/// Tells whether a layer, counted from 0, is oriented.
inline bool isOriented(const PrintParams& params, int layer) {
  const bool onBed = params.showSide != ShowSide::Up && layer < params.layers;
  const int below = params.showSide == ShowSide::Up ? params.base : params.layers + params.base;
  return onBed || (layer >= below && layer < layersBelowRim(params));
}

/// The layers that a base layer lies next to.
enum class NextTo { Base, Oriented, OrientedOnBed };

/// Tells which layers a base layer lies next to; one between two oriented layers counts for the upper one.
/// \param turn  number of the base layer among its kind, from the lowest.
inline NextTo nextTo(const PrintParams& params, int turn) {
  if (turn == params.base - 1 && params.showSide != ShowSide::Bed) return NextTo::Oriented;
  if (turn == 0 && params.showSide == ShowSide::Bed) return NextTo::Oriented;
  return turn == 0 && params.showSide == ShowSide::Both ? NextTo::OrientedOnBed : NextTo::Base;
}

/// Top of a layer, counted from 0 [mm].
inline double layerTop(const PrintParams& params, int layer) {
  return params.startHeight + firstLayerHeight(params) + layer * params.layerHeight;
}

// The part of G-code export that can fail: it checks the input and lays out the job.

/// Checks and lays out the plates of a toolpath. \param across  null where needsAcross does not ask for it.
/// \return InvalidArgument, DoesNotFit or EmptyShape, as writeGcode.
Result<GcodeJob> prepareGcodeJob(const Toolpath& toolpath, const Toolpath* across, const Shape& shape,
                                 const Printer& printer, const PrintParams& params);

/// Checks and lays out a plate of patches. \return InvalidArgument, DoesNotFit or EmptyShape, as writePatches.
Result<GcodeJob> preparePatchJob(const PatchPlate& plate, const Printer& printer, const PrintParams& params);

// Range checks of the input of G-code export.

/// Checks, before anything is placed, all that single values tell: text, ranges, finite coordinates and widths.
/// \return the first fault: InvalidArgument, DoesNotFit (in height) or EmptyShape (no cycles). \param across  read
/// where needsAcross, and missing there if null.
std::optional<Error> checkGcodeInput(const Toolpath& toolpath, const Toolpath* across, const Shape& shape,
                                     const Printer& printer, const PrintParams& params);

/// Checks a plate of patches likewise. \return InvalidArgument, DoesNotFit or EmptyShape (no lines).
std::optional<Error> checkPatchInput(const PatchPlate& plate, const Printer& printer, const PrintParams& params);

/// The part of these checks that needs no toolpath.
std::optional<Error> checkPlateInput(const Shape& shape, const Printer& printer, const PrintParams& params);

}  // namespace sillon
