// Errors whose sentence stands in a list.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"

// Reasons for which readers of print files refuse a file; those of plates are in sillon/base/result.hpp.
namespace sillon::reason {

/// The lines of a sliced file are numbered, as hosts send them.
inline constexpr char kLinesNumbered[] = "LinesNumbered";
/// A sliced file marks no layers or surfaces.
inline constexpr char kNoMarks[] = "NoMarks";
/// The beads of a file leave the diameter of its filament open: they are `thinWidth` wide from filament of `thin`,
/// `wideWidth` from filament of `wide` [mm].
inline constexpr char kFilamentOpen[] = "FilamentOpen";
/// A sliced file pushes no filament by E.
inline constexpr char kNoFilament[] = "NoFilament";

}  // namespace sillon::reason

namespace sillon {

/// Makes an error with its sentence.
/// \param reason  one of reasonSentences()
/// \param values  values of its sentence
Error refused(ErrorCode code, const char* reason, std::vector<NamedValue> values = {});

}  // namespace sillon
