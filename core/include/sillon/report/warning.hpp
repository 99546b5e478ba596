// Warnings about a plate or its file, the visibility of its layers, and notes on its input. Each is
// a code with its values, and the English sentence made of them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/layers.hpp"
#include "sillon/settings/project.hpp"

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

/// Makes the warnings about a drawing that hold whatever becomes of it.
std::vector<Warning> drawingWarnings(const DrawingFacts& drawing);

/// Returns warnings as a JSON list of objects with `code`, `values` and `message`.
std::string warningsJson(const std::vector<Warning>& warnings);

/// A visible layer, and the shares of what it draws that are not seen, 0..1, each for one reason.
struct SeenLayer {
  std::size_t layer = 1;  ///< number of the layer, from 1
  LayerKind kind = LayerKind::Direction;
  Vec2 size;                     ///< size of its box, before it turns [mm]
  double thin = 0;               ///< share that is narrower than two beads
  double beside = 0;             ///< share beside the plate, or in its holes
  double underRim = 0;           ///< share under the rim
  double covered = 0;            ///< share covered by layers above
  double alike = 0;              ///< share within 15 degrees of what it lies on
  double module = 0;             ///< side of a code's modules [mm]
  std::optional<bool> readable;  ///< tells whether decoders read it; unset: it is no code
};

/// One note on a plate's input: what was taken for granted of it, or left out.
struct InputNote {
  const char* code;  ///< one of inputNoteSentences()
  std::vector<NamedValue> values;
  std::string message;  ///< one English sentence without a full stop
};

/// Returns the sentence of each code.
std::span<const Sentence> inputNoteSentences();

/// Makes the notes on a project's shape.
/// \param drawing  facts about the shape that was read.
std::vector<InputNote> inputNotes(const Project& project, const DrawingFacts& drawing);

}  // namespace sillon
