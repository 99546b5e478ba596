// Warnings about a plate or its file: a code with its values, and the English sentence made of
// them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/sentence.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {

/// Codes of warnings, in alphabetical order. The sentence of each (warningSentences) names the
/// values that it carries.
enum class WarningCode {
  AccelerationHeld,
  BaseTooThin,
  BlockMovesLow,
  DetailLost,
  DrawingFaint,
  DrawingLettersLost,
  DrawingOffPage,
  DrawingUnpainted,
  DrawingUnread,
  EndHot,
  EndLine,
  FillRatio,
  FlatBeads,
  LayerAlike,
  LayerBeside,
  LayerCovered,
  LayerLeftOut,
  LayerLettersLent,
  LayerLettersLost,
  LayerOnlyPicture,
  LayerUnderRim,
  LayerUnreadable,
  LettersLent,
  ManyBytes,
  ManyMoves,
  MaxFlowSlows,
  MirroredUp,
  NoPressureAdvance,
  NotPrimed,
  NotPrimedAbovePrint,
  OutsideShape,
  PictureLost,
  PictureOneTone,
  PicturesCrowded,
  PressureAdvanceReset,
  PrintOnBed,
  PrintedApart,
  SegmentsSlow,
  SkirtLeftOut,
  SpeedHeld,
  StartFlow,
  StartLine,
  StartScales,
  StartTemperature,
  ThinLayers,
  ThinLetters,
  ThinModules,
  UnusualFilament,
  UnusualFlow,
  WidthHeld,
};

/// A warning with its values and its English sentence.
struct Warning {
  Warning(WarningCode code, std::vector<NamedValue> values = {});

  WarningCode code;
  std::vector<NamedValue> values;
  std::string message;  ///< one English sentence without a full stop

  /// Returns the value of that name, or null if there is none.
  [[nodiscard]] const NamedValue* value(const std::string& name) const;
};

/// Returns the name of a code, such as "SkirtLeftOut", which reports, the npm package and the
/// studio use.
const char* warningName(WarningCode code);

/// Returns the sentence of each code, in their order.
std::span<const Sentence> warningSentences();

/// Makes the warnings about letters that come from other fonts, or from none.
/// \param layer  number, from 1; 0: the plate's shape.
std::vector<Warning> letterWarnings(const std::vector<LackedLetter>& lacked, std::size_t layer);

/// Makes the warnings about a drawing that hold whatever becomes of it.
std::vector<Warning> drawingWarnings(const DrawingFacts& drawing);
/// Makes the same warnings about the drawing of a layer, or its mask.
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
                                   const std::vector<PictureFacts>& pictures,
                                   const std::optional<Measures>& measures, Vec2 page,
                                   double spacing);

/// Returns warnings as a JSON list of objects with `code`, `values` and `message`.
std::string warningsJson(const std::vector<Warning>& warnings);

}  // namespace sillon
