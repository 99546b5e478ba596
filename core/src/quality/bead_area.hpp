// Coverage, overlap and spill of a toolpath, counted on a raster of tau/20: docs/reference/metrics.md.
#pragma once

#include <cstdint>

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/geometry/signed_distance.hpp"

namespace sillon {

/// Pixels, judged at their centres.
struct BeadArea {
  std::int64_t shape = 0;       ///< inside the shape
  std::int64_t covered = 0;     ///< of those, below a bead
  std::int64_t spilled = 0;     ///< below a bead, outside the shape by more than 1 um, to which paths are rounded
  std::int64_t overlapped = 0;  ///< passed over more than once
};

/// Where the run takes most of its time: reports up to 0.8 of the current stage. What a cancelled run returns means
/// nothing.
/// \param border  of the shape. \param box  around the toolpath's points and the shape [mm].
BeadArea beadArea(const Toolpath& toolpath, const Shape& shape, const BorderIndex& border, const Bounds& box,
                  const RunContext& run);

}  // namespace sillon
