// What each cell is asked for: its zone, its mode and the line of the direction map (Sec. 4, 5).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/input/direction_map.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

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

struct CellConstraints {
  Grid grid;
  std::vector<Zone> zone;
  std::vector<DirectionMode> mode;
  std::vector<Vec2f> mapLine;  ///< z of d as the map asks, unit
};

/// Zones from the distance; modes from the nearest texel; lines averaged in z over the cell, or over a texel's size
/// where that is larger (or nearest, see MapFilter), and taken from the nearest texel where the average is shorter than
/// 0.1: the edges of mosaics, where it means nothing. Masked cells have neither mode nor line.
/// \param directions, modes  with as many values as pixels, at least one. \param page  over which both maps are
/// stretched [mm]. \return Cancelled.
Result<CellConstraints> cellConstraints(const SignedDistanceField& sdf, const DirectionMap& directions,
                                        const ModeMap& modes, Vec2 page, const ToolpathParams& params,
                                        const RunContext& run);

/// z of the bead direction for each of the 65536 angles of a DirectionMap.
std::vector<Vec2f> beadLines();

/// A texel of a map; row 0 on top.
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
/// The texel under a point of the page [mm], clamped at the edges. \param width, height  of the map [texels].
inline TexelIndex texelAt(Vec2 p, Vec2 page, int width, int height) {
  return {texelColumn(p.x, page.x, width), texelRow(p.y, page.y, height)};
}

}  // namespace sillon
