// The report of a plate: what was made, how good it is, what a print of it takes, and what should
// be known of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sillon/gcode_reader/check.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// One picture of a plate as it was judged.
struct ReportedPicture {
  std::size_t layer = 1;  ///< number of its layer, from 1
  std::string file;
  Lamp lamp;
  PictureMeasures measures;
};

/// The time and the plastic of a print.
struct PrintTotals {
  double seconds = 0;
  double filamentMm = 0;
  double grams = 0;
};

/// Facts about a plate. docs/reference/report.md lists the keys of the JSON and their meaning.
struct Report {
  double spacing = 0;  ///< tau [mm]
  int nx = 0;          ///< number of cells of tau/2 from left to right
  int ny = 0;
  std::int64_t parts = 0;
  std::int64_t cycles = 0;  ///< closed curves before stitching
  std::int64_t toolpaths = 0;
  std::int64_t points = 0;
  std::optional<Measures> measures;  ///< unset: their keys are left out
  double longestJointMm = 0;
  std::int64_t gapJoints = 0;
  std::int64_t unjoined = 0;
  std::vector<Vec2> apart;
  std::vector<StageTime> time;
  std::string digest;
  /// Peak memory of the process, as measured by the caller; 0: unknown
  std::int64_t peakBytes = 0;
  int threads = 1;                        ///< number of threads that the run was allowed
  std::vector<ReportedPicture> pictures;  ///< empty: left out
  std::vector<SeenLayer> layers;          ///< one per visible layer; empty: left out
  bool fromGcode = false;  ///< the pictures were judged by the G-code, not by the toolpath
  std::optional<PrintTotals> print;     ///< unset: left out
  std::optional<NeighbourDelay> delay;  ///< unset: left out
  std::vector<InputNote> notes;         ///< notes on the drawings of the shape and of layers
  std::vector<Warning> warnings;
};

/// Collects the facts of a toolpath, and its measures where there are any.
Report reportOf(const ToolpathResult& plate, const std::optional<Measures>& measures);

/// Writes the report as JSON, with the same bytes on every platform.
std::string reportJson(const Report& report);

/// Makes the lines for the header of a plate's G-code (PrintParams::notes): how it was made, and
/// its measures.
std::vector<std::string> plateNotes(const ToolpathParams& params,
                                    const std::optional<Measures>& measures);

}  // namespace sillon
