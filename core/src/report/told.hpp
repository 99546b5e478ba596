// Makes the warnings and notes about a plate.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/warning.hpp"

namespace sillon {

/// Makes the warnings about letters that come from other fonts, or from none.
/// \param layer  number, from 1; 0: the plate's shape.
std::vector<Warning> letterWarnings(const std::vector<LackedLetter>& lacked, std::size_t layer);

/// Makes the warnings of drawingWarnings about the drawing of a layer, or its mask.
/// \param layer  number, from 1; a value of each warning.
std::vector<Warning> drawingWarnings(const DrawingFacts& drawing, std::size_t layer);

/// Makes the warnings about pictures. They name those of one tone, and the one that is shown least
/// if its r is below 0.7, at which few recognise it. Either one direction per place has to show
/// several pictures, or the beads are too wide for it.
std::vector<Warning> pictureWarnings(const std::vector<PictureFacts>& pictures);

/// Makes all warnings about a plate before there is G-code: about its drawing, toolpaths that could
/// not be joined to the rest of their part, its pictures, and places narrower than a bead, where
/// they are more than 0.5 % of the shape.
/// \param apart  ToolpathResult::apart.
/// \param measures  measures of the plate; none: no lost places are reported.
/// \param page  size of the plate [mm].
/// \param spacing  tau [mm].
std::vector<Warning> plateWarnings(const DrawingFacts& drawing, const std::vector<Vec2>& apart,
                                   const std::vector<PictureFacts>& pictures, const std::optional<Measures>& measures,
                                   Vec2 page, double spacing);

/// Makes warnings about layers that are not seen: letters and codes of which more than 2 % are
/// hidden or alike; drawings of which more than 2 % are hidden or 10 % alike; others of which less
/// than 2 % are left; thin letters and modules; and codes that cannot be read.
/// \param page  size of the plate [mm].
/// \param spacing  tau [mm].
std::vector<Warning> layerWarnings(const std::vector<SeenLayer>& layers, Vec2 page, double spacing);

/// Makes the notes on the drawing of a layer.
/// \param drawing  facts about the layer's drawing, or its mask.
/// \param layer  number, from 1; a value of each note.
std::vector<InputNote> layerNotes(const DrawingFacts& drawing, std::size_t layer);

/// Returns notes as a JSON list of objects with `code`, `values` and `message`.
std::string notesJson(const std::vector<InputNote>& notes);

}  // namespace sillon
