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

/// Conflicts in the cells of the directions, row 0 on top.
struct PictureConflict {
  int width = 0;
  int height = 0;
  /// Light that is missing, per picture and cell: the tone asked for minus the tone that the
  /// direction shows under the picture's lamp. Tones are sRGB codes, scaled to 1 from the darkest
  /// direction to white at `level`; the difference is cut off at -1 and 1. Above 0 light is
  /// missing, below 0 there is too much.
  std::vector<std::vector<float>> missing;
};

/// Measures conflicts by directions alone, without the changes that beads and their ends make.
/// \param shown  at least one picture; stretched over the page of the directions.
/// \param roughness  roughness in range.
/// \param level  light of white, as solveDirections returned it.
/// \return nothing where the sizes of maps and their values do not fit each other.
PictureConflict conflictOf(const DirectionMap& directions, std::span<const ShownPicture> shown,
                           const Roughness& roughness, double level);

/// Draws a conflict: the picture in pale greys, orange where it stays too dark, blue where it
/// becomes too bright; the greater the difference, the fuller the colour. Each cell is a square of
/// at least one pixel, as large as fits into `side`.
/// \param picture  index of the picture.
/// \param tones  tones of that picture, stretched over the page.
/// \param side  most pixels of the longer side.
RgbImage conflictImage(const PictureConflict& conflict, std::size_t picture, const Tones& tones,
                       int side);

}  // namespace sillon
