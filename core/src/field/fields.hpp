// The fields of a plate, in the order in which they are made (Sec. 5.1 to 5.4): constraints, lines, spacing, phases,
// waves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Constraints of each cell: its zone, its mode and the line of the direction map (Sec. 4, 5).

/// Bands parallel to the border, from outside in.
enum class Zone : std::uint8_t {
  Masked,  ///< distance > -tau/2: no bead's centre lies here
  Ring,    ///< -tau < distance <= -tau/2: the first bead
  Shell,   ///< -perimeters tau < distance <= -tau: further perimeters
  Infill,
};

/// A line d is kept as the number z = e^{2i angle(d)}, which is the same for d and -d. Maps speak of the bead's
/// direction t, the optimiser of d = t turned by 90 degrees, in which the field varies: z(d) = -z(t).
inline Vec2f acrossBead(Vec2f beadLine) { return -beadLine; }

/// Constraints by cell.
struct CellConstraints {
  Grid grid;
  std::vector<Zone> zone;
  std::vector<DirectionMode> mode;
  std::vector<Vec2f> mapLine;  ///< z of the line d that the map asks for, unit
};

/// Derives zones from the distance and modes from the nearest texel. Lines are averaged as z over the cell, or over a
/// texel's size where that is larger (or taken from the nearest texel, see MapFilter). Where the average is shorter
/// than 0.1, as at the edges of mosaics, it means nothing, and the nearest texel is taken. Masked cells have neither
/// mode nor line.
/// \param directions, modes  maps with as many values as pixels, at least one. \param page  size of the page over which
/// both maps are stretched [mm]. \return Cancelled.
Result<CellConstraints> cellConstraints(const SignedDistanceField& sdf, const DirectionMap& directions,
                                        const ModeMap& modes, Vec2 page, const ToolpathParams& params,
                                        const RunContext& run);

/// Table of z of the bead direction for each of the 65536 angles of a DirectionMap.
std::vector<Vec2f> beadLines();

/// Indices of a map's texel; row 0 is on top.
struct TexelIndex {
  int x = 0;
  int y = 0;
};
inline int texelColumn(double x, double page, int width) {
  return static_cast<int>(std::clamp(x / page * width, 0.0, width - 1.0));
}
inline int texelRow(double y, double page, int height) {
  return static_cast<int>(std::clamp((page - y) / page * height, 0.0, height - 1.0));
}
/// The texel under a point of the page [mm], clamped at the edges. \param width, height  size of the map [texels].
inline TexelIndex texelAt(Vec2 p, Vec2 page, int width, int height) {
  return {texelColumn(p.x, page.x, width), texelRow(p.y, page.y, height)};
}

// Lines: initialisation and smoothing (Sec. 5.1, Eq. 1-5).

/// The direction d of greatest variation per cell, d = -d; beads run across it.
struct LineField {
  Grid grid;
  std::vector<Vec2f> direction;     ///< unit representatives; (0, 0) where masked
  std::vector<std::uint8_t> fixed;  ///< 1 where the line was asked for, 0 where smoothing decided
};

/// Chooses the line of every cell. Ring cells take the border's normal (mode Count), constrained cells the map,
/// parallel and orthogonal cells the base line (the normal of the ring diffused over the whole shape) or its
/// perpendicular; smoothest cells end as the average of their neighbours. Cells in which the average vanishes keep
/// their old line.
Result<LineField> lineField(const SignedDistanceField& sdf, const CellConstraints& cells, const ToolpathParams& params,
                            const RunContext& run);

// Alignment of the local waves (Sec. 5.2, Eq. 6-12).

/// One wave per cell: sin(pi/tau (x - p) . k + phi) around the cell's centre p (Eq. 6); (k, phi) = (-k, pi - phi).
/// Phases are kept as unit numbers q = e^{i phi}. Masked cells have k = q = 0.
struct SineField {
  Grid grid;
  double spacing = 0;        ///< tau; a period of 2 tau holds two beads
  std::vector<Vec2f> wave;   ///< k = frequency times the unit direction d
  std::vector<Vec2f> phase;  ///< q, unit
};

/// Aligns all waves over the hierarchy. In mode Count the ring's phase is fixed so that the first bead lies half a bead
/// inside the border; in mode Soft the border's wave joins the sum of ring cells as one more neighbour.
/// \param frequency  frequency of the wave per cell, from spacingField.
Result<SineField> alignPhases(const LineField& lines, std::vector<float> frequency, const SignedDistanceField& sdf,
                              const CellConstraints& cells, const ToolpathParams& params, const RunContext& run);

// Lines give way by a few degrees, and the spacing with them, where the waves ask for it.

/// Lines and frequencies as one round of alignment would have them.
struct RelaxedDirections {
  LineField lines;
  std::vector<float> frequency;  ///< per cell, as from spacingField
};

/// Turns the lines towards the beads that the waves make. The gradient of the aligned phases over neighbouring cells
/// tells how the beads really run and how far apart they lie. Each line is turned towards it from the line that was
/// asked for, by at most `directionTolerance`, and the frequency follows it within e^`spacingVariation`; both are
/// averaged twice over neighbours that run alike. Cells in which the phase jumps by more than 1.2 rad, and rings whose
/// beads follow the border whatever the picture says, stay as they are. \param asked  the lines as lineField made them.
/// \param frequency  the frequency with which the waves were aligned.
Result<RelaxedDirections> relaxDirections(const LineField& asked, const std::vector<float>& frequency,
                                          const SineField& waves, const CellConstraints& cells,
                                          const ToolpathParams& params, const RunContext& run);

// Bends the spacing so that the lines can be the gradient of one wave.

/// Frequency of the wave per cell, in units of pi/tau: beads lie tau / frequency apart. Where lines fan out, a constant
/// spacing asks for new beads, which begin at U-turns; beads that widen a little need none. With u = log frequency and
/// t the bead's direction, e^u d is a gradient where the derivative of u along t is the lines' divergence, -curl d; u
/// solves that by least squares, held to 0 over a length of 8 spacings and to |u| <= spacingVariation. A ring whose
/// beads follow the border whatever the picture says (mode Count) is left out. \return one value per cell, 1 where
/// masked and everywhere if spacingVariation is 0; Cancelled.
Result<std::vector<float>> spacingField(const LineField& lines, const CellConstraints& cells,
                                        const ToolpathParams& params, const RunContext& run);

// The scalar field whose zeros are the beads (Sec. 5.4, Eq. 13).

/// Values of the field on the node lattice of its grid (nodeLattice), row-major: the Gaussian mean of the waves (sigma
/// is a third of `kernelRadius`), in [-1, 1]. Within tau/2 of the border it is the ramp 2 sd/tau + 1, and outside 1, so
/// that all contours close inside the shape. \param nodeDistance  signed distance on the same lattice [mm], exact where
/// >= -tau/2.
Result<std::vector<float>> evaluateSineField(const SineField& field, const std::vector<float>& nodeDistance,
                                             const ToolpathParams& params, const RunContext& run);

// Counts dislocations of the waves.

/// Goes round every 2 x 2 block of unmasked cells: the phase gains a whole number of turns there, the block's index.
Dislocations findDislocations(const LineField& lines, const SineField& waves, const CellConstraints& cells,
                              const SignedDistanceField& sdf, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
