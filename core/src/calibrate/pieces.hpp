// What calibration plates are made of: filled polygons, spirals, wedges, wavy rows, writing.
#pragma once

#include <string_view>
#include <vector>

#include "sillon/gcode/patches.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

Ring box(Vec2 low, Vec2 high);
Ring disc(Vec2 centre, double radius);

/// Zigzag through a convex polygon, half a bead off its border. Where it is a rectangle of whole beads, lines along a
/// side, its cells are the rectangle less one bead's square.
/// \param polygon  counter-clockwise. \param along  of the lines, of length 1. \param width  of bead and spacing [mm].
std::vector<PatchLine> filled(const Ring& polygon, Vec2 along, double width);

inline constexpr int kSpiralSteps = 72;  ///< straight pieces of a turn

/// One bead round and round, from the middle out: at angle a, in turns, its radius is `pitch` times a plus whole turns.
/// If the pitch is the width, its cells are the disc.
/// \param radius  [mm], more than `pitch`.
PatchLine spiral(Vec2 centre, double radius, double width, double pitch);

/// `lines` beads side by side along +x, as one zigzag, whose width grows evenly. Their cells are the trapezoid less
/// the ends of its joints.
PatchLine wedge(Vec2 leftMiddle, double length, int lines, double from, double to);

/// `lines` (even) beads side by side along +x, as one zigzag, that are by turns a quarter wider and narrower than
/// `width`, over waves of 9 mm. Their cells are the rectangle. \param length  [mm], `width` plus a multiple of 9.
PatchLine wavyRow(Vec2 corner, double length, int lines, double width);

/// Writing. \param unit  a sixth of a capital's height [mm].
std::vector<PatchLine> writing(std::string_view text, Vec2 corner, double unit, double width);

/// A straight bead.
PatchLine stroke(Vec2 from, Vec2 to, double width);

}  // namespace sillon
