// The JSON report of a plate.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sillon/measure.hpp"
#include "sillon/params.hpp"
#include "sillon/pipeline.hpp"

namespace sillon {

/// Keys and meaning: docs/report.md. Without measures their keys are left out, but not the digest.
/// \param peakBytes  of the process, as measured by the caller; 0 if unknown.
std::string reportJson(const Plate& plate, const std::optional<Measures>& measures, int threads,
                       std::int64_t peakBytes);

/// What made a plate and how good it is, for the header of its G-code (PrintParams::notes).
std::vector<std::string> plateNotes(const ToolpathParams& params, const std::optional<Measures>& measures);

}  // namespace sillon
