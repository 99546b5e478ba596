// Conflicts between pictures on one plate: one direction per place cannot show every set of
// tones.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/look/inversion.hpp"

namespace sillon {

/// In the cells of the directions, row 0 on top.
struct PictureConflict {
  int width = 0;
  int height = 0;
  /// Per picture and cell: the tone asked for minus the tone that the direction shows under the
  /// picture's lamp, as sRGB codes, 1 from the darkest direction to white at `level`; -1..1, what
  /// is more is cut off. Above 0 light is missing, below 0 there is too much.
  std::vector<std::vector<float>> missing;
};

/// Measures conflicts by directions alone, without what beads and their ends change.
/// \param shown  at least one; stretched over the page of the directions.
/// \param roughness  in range.
/// \param level  light of white, as solveDirections returned it.
/// \return nothing where the sizes of maps and their values do not fit each other.
PictureConflict conflictOf(const DirectionMap& directions, std::span<const ShownPicture> shown,
                           const Roughness& roughness, double level);

/// Drawn: the picture in pale greys, orange where it stays too dark, blue where it becomes too
/// bright, the fuller the more. Each cell is a square of as many pixels as the longer side of at
/// most `side` takes, at least one.
/// \param picture  which of them.
/// \param tones  its own, stretched over the page.
RgbImage conflictImage(const PictureConflict& conflict, std::size_t picture, const Tones& tones,
                       int side);

}  // namespace sillon
