// Why a job is refused, as codes: what `Error::reason` may be, for those who say it in another language than English.
// Besides: the name of a warning (report/warning.hpp) that is no mere warning here, with its values.
#pragma once

#include <span>

#include "sillon/base/sentence.hpp"

namespace sillon::reason {

/// A number of a project: `setting` ("print.layerHeight"), `value`, `low`, `high`, in the setting's own unit.
inline constexpr char kSettingOutOfRange[] = "SettingOutOfRange";
/// The plate on the bed: `left`, `right`, `front`, `back`: by how much it lies over that edge [mm]; those that it does.
inline constexpr char kOverBedEdge[] = "OverBedEdge";
/// On a round bed: `by` [mm].
inline constexpr char kOverRoundBed[] = "OverRoundBed";
/// The plate touches the part of the bed that the printer's profile excludes.
inline constexpr char kOnExcludedZone[] = "OnExcludedZone";
/// The job with its lift: `height`, and `most`, which the printer reaches [mm].
inline constexpr char kTooHigh[] = "TooHigh";
/// Several plates on one bed: `height`, and `most`, at which the print head passes over the others [mm].
inline constexpr char kCopiesTooHigh[] = "CopiesTooHigh";
/// No bead fits anywhere: `spacing` [mm].
inline constexpr char kNoBeadFits[] = "NoBeadFits";
/// More cells than there may be: `spacing` [mm]; `leastSpacing` [mm] and `percent` of the size, at which it would do,
/// each where there is one.
inline constexpr char kPlateTooLarge[] = "PlateTooLarge";

}  // namespace sillon::reason

namespace sillon {

/// The sentences of reasons whose errors say nothing else.
std::span<const Sentence> reasonSentences();

/// What helps against most errors of a code, by its name; codes whose messages say it themselves have none.
std::span<const Sentence> errorHints();

}  // namespace sillon
