// The steps from closed curves to the path (Sec. 5.4 to 5.6).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "field/fields.hpp"
#include "geometry/parts.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Thin features that the waves passed over: arms and parts hardly wider than a bead.

/// Gives places near the border that no contour comes to a contour of their own: where a wave is positive all over an
/// arm hardly wider than a bead, its contours end at the arm's mouth. Nodes of the lattice there become negative. So do
/// those along the middle of lines up to 1.35 beads wide, as the lattice may have no node in such a line that is deep
/// enough.
/// \param nodes     lattice of the contour, cells of tau/4.
/// \param distance  signed distances at the nodes, exact within `spacing` of the border [mm].
/// \param spacing   tau [mm].
/// \param values    sine field at the nodes; negative inside of a contour.
void fillThinFeatures(const Grid& nodes, const std::vector<float>& distance, const BorderIndex& border, double spacing,
                      std::vector<float>& values);

/// Gives every part that can hold a bead a contour: in parts that no contour has found, the values at the cells in
/// which a bead has room become negative.
/// \param values  on the node lattice of the parts' grid.
void keepThinParts(const Parts& parts, const SignedDistanceField& sdf, const BorderIndex& border, double spacing,
                   std::vector<float>& values);

// Zero contours of the field as disjoint closed curves: marching squares (Sec. 5.4).

/// Least distance of a vertex from the ends of its lattice edge, as a share of it, so that vertices of touching edges
/// never coincide, not even on 1 µm.
inline constexpr float kMinRoot = 0.03f;

/// Traces the zeros of a field as closed curves. There is one vertex per lattice edge whose ends differ in sign, zero
/// counting as positive: at the root of the phase (arc sine) where both ends lie deeper inside than half a spacing, at
/// that of the value elsewhere, and a little off both ends. Larger values lie on the left of every curve, so that
/// neighbouring curves run in opposite senses. Order and orientation are fixed by the lowest edge.
/// \param values    nx x ny, positive on the frame.
/// \param distance  nx x ny signed distances [mm].
/// \return TooLarge from 2^30 vertices on, or Cancelled.
Result<ClosedCurves> contourCycles(const Grid& lattice, const std::vector<float>& values,
                                   const std::vector<float>& distance, double spacing, const RunContext& run);

/// Moves the vertices of contours along their lattice edges, away from those of other beads nearer than half a spacing
/// (Sec. 5.6, Eq. 15), in `repulsionRounds`. Vertices stay between the nodes of a lattice of tau/4, so that they move
/// less than in the paper, whose edges are twice as long. Sums follow the order of the points, for the same bytes with
/// any threads.
ClosedCurves repulsed(ClosedCurves curves, const Grid& lattice, const ToolpathParams& params, const RunContext& run);

// Cycles too short to turn once round without a kink.

/// Takes care of cycles too short for a bead. Cycles that lie at the border all round, along spurs and cracks whose
/// sides fall together, are left out: their beads would be next to nothing. So are the shortest ones, dots of less than
/// a bead, close beside a longer one: they would add two U-turns and cover next to nothing. Other short cycles become
/// circles of about their length, or of less where there is no room for that, at the deepest place nearby, as the
/// nozzle can go round those. They stay as they are beside another cycle, to which they will be joined, and where even
/// the smallest circle would come too near to the border. The limits, in spacings, are the constants in
/// small_cycles.cpp.
/// \param curves  closed curves that do not meet, their points at most about a quarter of a spacing apart.
ClosedCurves regularizeSmallCycles(const ClosedCurves& curves, const BorderIndex& border, double spacing,
                                   const RunContext& run);

// Joins the contour's cycles into one per connected part (Sec. 5.5, Eq. 14, Alg. 2).

/// The result of stitching.
struct Stitched {
  ClosedCurves curves;      ///< in order of their parts' lowest cells
  int parts = 0;            ///< connected parts that hold a curve
  double longestJoint = 0;  ///< [mm]
  int gapJoints = 0;        ///< joints that lie outside the shape in part
  std::vector<Vec2>
      apart;              ///< middles of the boxes of curves that could not be joined to the longest of their part [mm]
  std::int64_t work = 0;  ///< joints looked at, each counted as its length in spacings, at least 1

  /// Number of curves that could not be joined to the others of their part.
  [[nodiscard]] int unjoined() const { return curves.count() - parts; }
};

/// Joins the curves of each part into one: takes a piece about one spacing long out of each of two curves and closes
/// the gap with two new edges. All places where different curves run side by side are candidates; they are taken in
/// order of cost (a minimal spanning tree: n log n), unless a new edge, or the line between the pieces' middles, meets
/// another, leaves the shape, or touches a used piece. The cost is 0.65 times the added length (Eq. 14) plus
/// `stitchAlignment` times the misaligned length added.
/// Joints cross gaps only where a part is not one curve otherwise: first between neighbours, as far as `bridge` allows;
/// then wherever points of two curves face each other with nothing between them, those that leave the shape least
/// first, each edge for at most eight spacings, or about two and a half bridges where these are more. No edge gets
/// farther from the shape than half a bridge and half a bead. Where points are used up, the paths made so far are
/// curves again, and are joined once more, a few times. A curve that is not joined then stays a curve of its own. The
/// work is bounded: a constant number of rounds, each of n log n in the points and cells.
/// \param curves  equally spaced points, tau/4 apart, neighbours in opposite senses.
Result<Stitched> stitchCycles(const ClosedCurves& curves, const LineField& lines, const BorderIndex& border,
                              const Parts& parts, const ToolpathParams& params, const RunContext& run);

// Room on either side of every point of a path (Eq. 16, taken separately to the left and to the right).

/// Diameters of the smallest circles that touch the path at a point from the left or right and pass through a point of
/// another piece of path: for parallel neighbours their distance. The border counts as a neighbour at twice its
/// distance.
struct BeadGaps {
  std::vector<float> left;  ///< [mm], at most the cap
  std::vector<float> right;
  std::vector<char> tight;  ///< not 0 where the path may meet itself: another piece within 0.3 spacings, a sharp turn
};

/// Measures the gaps on both sides of every point. Points of the same curve nearer than one spacing along it are not
/// neighbours. Further ones are, so that a U-turn's legs keep their distance from each other; round its tip the
/// touching circle is the tip itself, as it should be. (Leaving out 2.5 spacings lets the legs be pressed together: ten
/// times the kinks.)
/// \param curves  points tau/4 apart.
/// \param cap     largest gap looked for [mm].
BeadGaps beadGaps(const ClosedCurves& curves, const BorderIndex& border, double spacing, float cap,
                  const RunContext& run);

// Evens out the spacing of the stitched path; replaces the repulsion of Sec. 5.6 (Eq. 15).

/// The result of relaxation.
struct Relaxed {
  ClosedCurves curves;  ///< points tau/4 apart
  BeadGaps gaps;        ///< gaps of `curves`, at most 1.5 tau
};

/// Evens out gaps in rounds. Each moves every point by `relaxationStrength` times the difference of its gaps towards
/// the wider side (more beside the border and where the difference is above a quarter of tau; at most 0.15 tau),
/// smooths the moves along the path, pulls each point towards the middle of its neighbours and resamples at tau/4.
/// Moves of a round that would make the path meet itself are halved there, to nothing in the end: a simple path stays
/// simple (checked exactly on 1 µm). The last round ends with `roundKinks`. The published repulsion pushes apart
/// only points nearer than tau/2.
/// \param asked  if not null, every round but the last turns the beads towards these lines, the last time less, and
/// gaps are evened out by at least a quarter of their difference: the tones of a picture come nearer to those asked
/// for. With two rounds or more, two are added then, and points are pulled to their neighbours' middle by 0.3 at most.
Result<Relaxed> relaxSpacing(ClosedCurves curves, const BorderIndex& border, const ToolpathParams& params,
                             const RunContext& run, const LineField* asked = nullptr);

// Bead widths that fill the room between the beads (Sec. 5.6, Eq. 16).

/// Widths by point of the path.
struct BeadWidths {
  std::vector<float> width;  ///< [mm]
  std::vector<float> limit;  ///< twice the distance to the border: wider beads spill [mm]; large where it is far
};

/// Chooses the width at every point: between the smaller of the two gaps at its sides (Eq. 16: 1-2 % of the area stays
/// empty) and their mean (the whole room), by `widthBalance`; held to [minWidth, maxWidth] spacings and, so that no
/// bead spills, to twice the distance to the border. Where two beads would then overlap by more than `beadOverlap`
/// spacings, both give way in proportion.
/// \param gaps  gaps of these curves.
Result<BeadWidths> beadWidths(const ClosedCurves& curves, const BeadGaps& gaps, const BorderIndex& border,
                              const ToolpathParams& params, const RunContext& run);

// The finished toolpath: rounded to what is written, without points that say nothing.

/// Rounds to 1 µm and leaves out points whose position and width follow from those kept within `simplifyTolerance`
/// (segments stay below 2 mm, so that widths and speeds can follow; no bead grows over the border by it). Where that
/// would make the path meet itself, the points stay.
Result<Toolpath> finishToolpath(const ClosedCurves& curves, const BeadWidths& widths, const ToolpathParams& params,
                                const RunContext& run);

// Checks of a toolpath before it is drawn: somebody may have changed it.

/// Tells why no plate can have this page [mm]; nothing if one can.
std::optional<Error> pageDefect(Vec2 page);

/// Tells why the toolpath or its page [mm] cannot be drawn; nothing if they can.
std::optional<Error> toolpathDefect(const Toolpath& toolpath, Vec2 page);

}  // namespace sillon
