// From shape and directions to the toolpath: the stages in order, no maths (Alg. 1).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/field/dislocations.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

struct StageTime {
  std::string stage;
  double seconds = 0;
};

/// The toolpath and what was seen on the way.
struct ToolpathResult {
  Toolpath toolpath;
  int nx = 0;  ///< cells of tau/2
  int ny = 0;
  std::int64_t parts = 0;          ///< connected parts after bridging
  std::int64_t contourCycles = 0;  ///< closed curves before stitching
  double longestJointMm = 0;
  int gapJoints = 0;                         ///< joints that cross a gap between solids
  int unjoined = 0;                          ///< toolpaths more than parts: no joint to the rest of a part was possible
  std::vector<Vec2> apart;                   ///< where those toolpaths lie: middles of their boxes [mm]
  std::int64_t stitchWork = 0;               ///< joints looked at while stitching, see Stitched
  std::vector<StageTime> time;               ///< in order; the sum is the total
  std::optional<Dislocations> dislocations;  ///< of the waves, where they were asked for; not in `time`
};

/// \param countDislocations  for measureToolpath, which else makes the waves anew.
/// \return InvalidArgument (which field, its value, its range), EmptyShape, TooLarge or Cancelled.
Result<ToolpathResult> generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                        bool countDislocations = false);

/// The path of the layer below: its beads run across those of generateToolpath, except along the border, so that
/// nothing of it shows through them. Takes about as long. \return as generateToolpath.
Result<ToolpathResult> generateAcross(const PlateInput& input, const ToolpathParams& params, const RunContext& run);

}  // namespace sillon
