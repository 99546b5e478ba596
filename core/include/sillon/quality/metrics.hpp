// Measures of a toolpath: alignment, coverage, turns, and likeness of pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Measures of a plate: alignment (Eq. 17), coverage and overlap (Tab. 5), turns, widths, crossings.
// docs/reference/metrics.md defines them.

/// Length-weighted distribution of the delivered widths, in spacings.
struct WidthMeasures {
  double p01 = 0;
  double median = 0;
  double p99 = 0;
  double belowHalf = 0;  ///< share of the length narrower than half a spacing
  /// Share of the length at the allowed minimum or maximum, or narrower at a border
  double clamped = 0;
};

/// Measures of a toolpath. Areas are shares of the shape's area in percent. NaN never occurs; an
/// empty toolpath measures 0.
struct Measures {
  double lengthMm = 0;
  double alignment = 0;             ///< -1 perfect, -0.5 chance, 0 orthogonal; every piece
  double alignmentInterior = 0;     ///< pieces deeper than 1.05 tau
  double alignmentConstrained = 0;  ///< constrained pieces inside all counted perimeters; 0: none
  double coverage = 0;              ///< share under at least one bead [%]
  double overlap = 0;               ///< share that is passed at least twice [%]
  double spill = 0;                 ///< area under a bead, but outside the shape [%]
  double fillRatio = 0;             ///< area of the beads divided by the shape's, a ratio
  double shapeAreaMm2 = 0;
  double lostAreaMm2 = 0;  ///< area of all lost places
  /// Places that no bead of one spacing can reach, the largest first. Each counts as wide as a
  /// strip of the same mean depth, but at most as wide as its thickest point, to within tau/8.
  std::vector<ThinPlace> lostPlaces;
  double keptAreaMm2 = 0;             ///< area of all kept places
  std::vector<ThinPlace> keptPlaces;  ///< places that were widened to one bead (keepThinPlaces)
  std::int64_t uTurns = 0;
  std::int64_t kinks = 0;
  /// Pairs of non-consecutive segments that share a point, on coordinates of 1 µm
  std::int64_t crossings = 0;
  /// Dislocations of the waves that these directions make: beads that begin or end
  std::int64_t dislocations = 0;
  /// Singularities of the lines: places round which they turn by half a turn
  std::int64_t singularities = 0;
  /// Estimate of the dislocations that the directions force at one constant spacing
  double dislocationBound = 0;
  /// Estimate of uTurns: dislocationBound, plus the U-turns where beads meet the border
  double turnBound = 0;
  WidthMeasures width;
  std::string digest;  ///< 16 hex digits of the toolpath on a grid of 1 µm
};

/// Judges a toolpath as delivered. It takes a fifth to two fifths as long as making it.
/// \param input  input that the toolpath was made from.
/// \param dislocations  dislocations of the waves of this input, where they are known
/// (ToolpathResult::dislocations).
/// \return InvalidArgument (which of the toolpath, the maps or the parameters is out of range),
/// TooLarge, OutOfMemory, the errors of resolveOutline, or Cancelled.
Result<Measures> measureToolpath(const Toolpath& toolpath, const PlateInput& input,
                                 const ToolpathParams& params, const RunContext& run,
                                 const std::optional<Dislocations>& dislocations = std::nullopt);

/// Returns a digest of points and widths in µm: equal digests mean equal plates. Widths that are
/// missing count as 0.
std::string digestOf(const Toolpath& toolpath);

/// Likeness of one picture, as a plate shows it under the picture's lamp.
struct PictureMeasures {
  /// Pearson's correlation of the visible image with the picture, both as sRGB codes of cells of 2
  /// tau; 0: flat
  double r = 0;
  /// Structural similarity of the same after the best affine fit, Gaussian window of 1.5 cells
  double ssim = 0;
  /// Light at the 99th percentile of the cells, divided by light at the 1st
  double contrast = 1;
  /// Values of r with each picture under this lamp, in order; its own r at its own place
  std::vector<double> others;
};

/// Likeness of one picture as warnings need it: r of what the plate shows with what was asked for,
/// -1..1.
struct PictureFacts {
  /// The picture has one tone, so that nothing can be seen in it, whatever its r
  bool oneTone = false;
  double fieldR = 1;  ///< r of the directions alone; 1: the plate has no other picture
  double seenR = 1;   ///< r of the beads; 1: not measured
};

}  // namespace sillon
