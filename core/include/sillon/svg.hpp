// SVG text to a Shape.
#pragma once

#include <string_view>

#include "sillon/shape.hpp"

namespace sillon {

struct SvgOptions {
  /// Size of a page length without unit: 1/96 inch in SVG; the published scene files mean mm.
  bool unitlessIsMm = false;
  double tolerance = 0.002;  ///< largest distance between a curve and its polygon [mm], > 0
};

/// Reads the filled geometry of an SVG document. All elements with area count whatever their paint (`fill="none"`
/// too); `display:none`, `<defs>`, `<line>` and text do not. The page is width x height of the root, or its viewBox.
/// \param text  the whole file; hostile input ends in an error, never in a crash or a hang.
/// \return points in mm, y up, snapped to 1 nm so that every platform reads the same bytes.
Result<Shape> readSvg(std::string_view text, const SvgOptions& options = {});

}  // namespace sillon
