// SVG text to a Shape.
#pragma once

#include <string_view>

#include "sillon/shape.hpp"

namespace sillon {

struct SvgOptions {
  /// Size of a page length without unit: 1/96 inch in SVG; the published scene files mean mm.
  bool unitlessIsMm = false;
  double tolerance = 0.002;  ///< largest distance between a curve and its polygon [mm], 0.0001..10
};

/// Reads the geometry of an SVG document. All paths and basic shapes with area count whatever their paint
/// (`fill="none"` too); what is `display:none` or only defined (`<defs>`, `<symbol>`, ...), `<line>`, text and images
/// do not; Shape::drawing counts text and images. The page is width x height of the root; a side that is missing or in
/// percent follows from the viewBox.
///
/// Read: all path commands, transforms, viewBox and preserveAspectRatio, nested `<svg>`, `<use>`, `<switch>`; fill-rule
/// and display from attributes, `style`, and `<style>` rules that select by name, class or id. Not read: clipping and
/// masking, `visibility`, CSS transforms, sizes in CSS, other selectors, `!important`. Stroke widths add nothing.
/// A broken attribute is an error that names its element and line: half a drawing would be printed unnoticed.
///
/// \param text  the whole file, UTF-8, up to 64 MiB; hostile input ends in an error, never in a crash or a hang.
/// \return points in mm, y up, snapped to 1 nm so that every platform reads the same bytes.
///   InvalidFile (what, where), EmptyShape (no area), InvalidArgument (tolerance), TooLarge (page over 100000 mm, more
///   than 2 million points, elements nested deeper than 200, `<use>` without measure).
Result<Shape> readSvg(std::string_view text, const SvgOptions& options = {});

}  // namespace sillon
