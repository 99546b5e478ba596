// A card that tells by its directions which filament it is, and how it was printed.
#pragma once

#include <optional>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Fills in shape, toolpath and values. \return the errors of generateToolpath.
std::optional<Error> addSwatch(CalibrationPlate& plate, const Project& project, const RunContext& run);

}  // namespace sillon
