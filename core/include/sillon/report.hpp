// The JSON report of a plate.
#pragma once

#include <cstdint>
#include <string>

#include "sillon/measure.hpp"
#include "sillon/pipeline.hpp"

namespace sillon {

/// Keys and meaning: docs/report.md. \param peakBytes  of the process, as measured by the caller; 0 if unknown.
std::string reportJson(const Plate& plate, const Measures& measures, int threads, std::int64_t peakBytes);

}  // namespace sillon
