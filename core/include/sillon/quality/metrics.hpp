// How good a plate is: alignment (Eq. 17), coverage and overlap (Tab. 5), turns, widths, crossings. Definitions:
// docs/reference/metrics.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/field/dislocations.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// Length-weighted distribution of the delivered widths, in spacings.
struct WidthMeasures {
  double p01 = 0;
  double median = 0;
  double p99 = 0;
  double belowHalf = 0;  ///< share of the length narrower than half a spacing
  double clamped = 0;    ///< share of the length at the allowed minimum or maximum, or narrower at a border
};

/// Areas are shares of the shape's area in percent. NaN never occurs; an empty toolpath measures 0.
struct Measures {
  double lengthMm = 0;
  double alignment = 0;             ///< -1 perfect, -0.5 chance, 0 orthogonal; every piece
  double alignmentInterior = 0;     ///< pieces deeper than 1.05 tau
  double alignmentConstrained = 0;  ///< constrained pieces inside all counted perimeters; 0: none
  double coverage = 0;              ///< [%]
  double overlap = 0;               ///< [%]
  double spill = 0;                 ///< [%]
  double fillRatio = 0;             ///< bead area / shape area, a ratio
  double shapeAreaMm2 = 0;
  double lostAreaMm2 = 0;  ///< of all lost places
  /// Which no bead of one spacing can reach, the largest first. As wide as a strip of the same mean depth, at most as
  /// the thickest point within tau/8.
  std::vector<ThinPlace> lostPlaces;
  double keptAreaMm2 = 0;             ///< of all kept places
  std::vector<ThinPlace> keptPlaces;  ///< which were widened to one bead (keepThinPlaces)
  std::int64_t uTurns = 0;
  std::int64_t kinks = 0;
  std::int64_t crossings = 0;      ///< pairs of non-consecutive segments that share a point, on coordinates of 1 µm
  std::int64_t dislocations = 0;   ///< of the waves that these directions make: beads that begin or end
  std::int64_t singularities = 0;  ///< of the lines: places round which they turn by half a turn
  double dislocationBound = 0;     ///< about as many are forced by the directions at one constant spacing
  double turnBound = 0;            ///< the same with the U-turns where beads meet the border: about as many as uTurns
  WidthMeasures width;
  std::string digest;  ///< 16 hex digits of the toolpath on a grid of 1 µm
};

/// Judges a toolpath as delivered. Takes a fifth to two fifths as long as making it.
/// \param input         what the toolpath was made of.
/// \param dislocations  those of the waves of this input, where they are known (ToolpathResult::dislocations).
/// \return InvalidArgument (what of the toolpath, the maps or the parameters is out of range), TooLarge, OutOfMemory,
/// the errors of resolveOutline, or Cancelled.
Result<Measures> measureToolpath(const Toolpath& toolpath, const PlateInput& input, const ToolpathParams& params,
                                 const RunContext& run, const std::optional<Dislocations>& dislocations = std::nullopt);

/// Pairs of non-consecutive segments that share a point, all cycles together, exact on integers of 1 µm.
std::int64_t countCrossings(const Toolpath& toolpath);

/// Digest of points and widths in µm: equal digests mean equal plates. Widths that are missing count as 0.
std::string digestOf(const Toolpath& toolpath);

}  // namespace sillon
