// The JSON report of a plate.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/quality/picture_measures.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// Keys and meaning: docs/reference/report.md. Without measures their keys are left out, but not the digest.
/// \param peakBytes  of the process, as measured by the caller; 0 if unknown.
std::string reportJson(const ToolpathResult& plate, const std::optional<Measures>& measures, int threads,
                       std::int64_t peakBytes);

/// A JSON object with one entry more behind the others. \param report  of reportJson. \param json  the entry's value.
std::string withEntry(std::string report, std::string_view name, std::string_view json);

/// The report with `pictures` as its last entry. \param report  of reportJson. \param measures  one per picture, and
/// what has none is left out; none: the report as it was. \param fromGcode  whether the G-code was judged, else the
/// toolpath.
std::string withPictures(std::string report, std::span<const ShownPicture> pictures,
                         std::span<const PictureMeasures> measures, bool fromGcode);

/// What made a plate and how good it is, for the header of its G-code (PrintParams::notes).
std::vector<std::string> plateNotes(const ToolpathParams& params, const std::optional<Measures>& measures);

}  // namespace sillon
