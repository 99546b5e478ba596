// Alignment of the local waves (Sec. 5.2, Eq. 6-12).
#pragma once

#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/field/line_field.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// One wave per cell: sin(pi/tau (x - p) . k + phi) around the cell's centre p (Eq. 6); (k, phi) = (-k, pi - phi).
/// Phases are kept as unit numbers q = e^{i phi}. Masked cells have k = q = 0.
struct SineField {
  Grid grid;
  double spacing = 0;        ///< tau; a period of 2 tau holds two beads
  std::vector<Vec2f> wave;   ///< k = frequency times the unit direction d
  std::vector<Vec2f> phase;  ///< q, unit
};

/// Phase of i [rad, not wrapped] that lays its wave over that of j: Eq. 8 at the midpoint, which is second order where
/// the published form, which takes only the line of j, is first order.
/// \param offset  p_i - p_j [mm]. \param frequency  pi/tau [rad/mm].
float alignedPhase(Vec2f offset, Vec2f di, Vec2f dj, float phaseJ, float frequency);

/// Aligns all waves over the hierarchy. In mode Count the ring's phase is fixed so that the first bead lies half a bead
/// inside the border; in mode Soft the border's wave joins the sum of ring cells as one more neighbour.
/// \param frequency  of the wave per cell, from spacingField.
Result<SineField> alignPhases(const LineField& lines, std::vector<float> frequency, const SignedDistanceField& sdf,
                              const CellConstraints& cells, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
