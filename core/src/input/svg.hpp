// Converts SVG text to a Shape, and to a picture.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "input/shaped_line.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

struct SvgOptions {
  /// Unit of a page length without unit. In SVG it is 1/96 inch; the published scene files mean mm.
  bool unitlessIsMm = false;
  /// Takes the outlines of all closed shapes, whatever their paint, and ignores strokes, clipping and the page's edges.
  /// The published scene files and CAD drawings are meant so. Pieces whose ends meet form one outline; outlines within
  /// others are holes, and outlines within holes are solid.
  bool ignorePaint = false;
  double width = 0;           ///< width to which the page is scaled [mm], 1e-6..1e5; 0 keeps the drawn size
  double tolerance = 0.002;   ///< largest distance between a curve and its polygon [mm], 0.0001..10
  ShapeLetters letters = {};  ///< function that draws text; without it text is left out
};

/// Reads the shape that an SVG document shows.
///
/// All painted areas are solid, also those with white, faint and graded paint. Fills and strokes count as viewers draw
/// them, within the page. If nothing at all is painted, outlines count whatever their paint, and Shape::drawing says
/// so. The page is width x height of the root; a side that is missing or in percent follows from the viewBox. Without
/// any size the page is the box of all that is painted.
///
/// Read: all path commands and basic shapes, transforms, viewBox and preserveAspectRatio, nested `<svg>`, `<use>`,
/// `<symbol>`, `<switch>`, `systemLanguage` (English) and `requiredExtensions` (none); fill, stroke with width, caps,
/// joins, miter limit, dashes and vector-effect, opacities, gradients (solid where they have a fifth or more of their
/// greatest opacity), context-fill and context-stroke of `<use>`, fill-rule, display, visibility, clip-path, mask (by
/// luminance or alpha: black hides, all else shows), overflow, transform with transform-origin and transform-box, from
/// attributes, `style` and `<style>` rules that select by names, classes, ids and nesting; `var()` by its fallback,
/// namespaces, entities of the DOCTYPE; text where SvgOptions::letters draws it, with places, shifts and turns of each
/// letter, anchors, base lines, spacing, slant, textLength, lines along it, white space and places on paths as in
/// browsers; files packed by gzip.
///
/// Not read, but reported in Shape::drawing: all else that changes or moves letters (light weights, small capitals,
/// direction, ...), style sheets beside the file, images, `<foreignObject>`, markers, filters, patterns (they count as
/// solid), gradients in masks, animation, sizes of shapes in CSS, shapes of clip-path and pictures of mask in CSS,
/// custom properties, `calc()`, 3D transforms, other selectors, nested rules, `@media` and similar rules, `pathLength`.
/// A broken attribute is an error that names its element and line, because otherwise half a drawing would be printed
/// unnoticed.
///
/// \param text  the whole file, UTF-8, up to 64 MiB; hostile input ends in an error, never in a crash or a hang.
/// \return points in mm, y up, snapped to 1 nm so that every platform reads the same bytes;
///   InvalidFile (what, where), EmptyShape (no area, or all of it off the page), InvalidArgument (tolerance, width),
///   TooLarge (page over 100000 mm, more than 2 million points or 100,000 bytes of letters, elements nested deeper than
///   200, too much work by `<use>`, clipping or rules).
Result<Shape> readSvg(std::string_view text, const SvgOptions& options = {});

/// Paint of a path of a drawing.
struct PathPaint {
  std::uint32_t colour = 0;  ///< 0xRRGGBB; for a gradient the mean of its stops
  double alpha = 1;          ///< 0..1
};

/// A drawing in its colours.
struct SvgPainting {
  Shape shape;
  std::vector<PathPaint> paints;  ///< one for each path of the shape; later ones lie on top
};

/// Reads a drawing in its colours. It draws like readSvg() and fails with the same errors.
Result<SvgPainting> readSvgPainting(std::string_view text, const SvgOptions& options = {});

/// Renders the page of a drawing as viewers show it: RGBA, clear where nothing is painted. Edges are not antialiased,
/// so that flat colours stay flat.
/// \param longest  longest side [pixels]; drawings with very many lines get fewer pixels, to bound the time.
Image paintedPicture(const SvgPainting& painting, int longest);

}  // namespace sillon
