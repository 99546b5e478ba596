// Makes toolpaths from shape and directions (Alg. 1), once or again and again.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// The way from shape and directions to the toolpath: the stages in order, no maths (Alg. 1).

/// Time that one stage took.
struct StageTime {
  std::string stage;
  double seconds = 0;
};

/// The toolpath and the counts made along the way.
struct ToolpathResult {
  Toolpath toolpath;
  int nx = 0;  ///< number of cells of tau/2 from left to right
  int ny = 0;
  std::int64_t parts = 0;          ///< connected parts after bridging
  std::int64_t contourCycles = 0;  ///< closed curves before stitching
  double longestJointMm = 0;
  int gapJoints = 0;  ///< joints that cross a gap between solids
  /// Number of toolpaths beyond one per part: no joint to the rest of a part was possible
  int unjoined = 0;
  std::vector<Vec2> apart;      ///< places of those toolpaths: middles of their boxes [mm]
  std::int64_t stitchWork = 0;  ///< joints looked at while stitching, as in Stitched::work
  std::vector<StageTime> time;  ///< time of each stage, in order; the sum is the total
  /// Dislocations of the waves, where they were asked for; not in `time`
  std::optional<Dislocations> dislocations;
};

/// Makes the toolpath of a plate.
/// \param countDislocations  counts them for measureToolpath, which otherwise makes the waves anew.
/// \return InvalidArgument (which field, its value, its range), EmptyShape, TooLarge or Cancelled.
Result<ToolpathResult> generateToolpath(const PlateInput& input, const ToolpathParams& params,
                                        const RunContext& run, bool countDislocations = false);

/// Makes the path of the layer below. Its beads run across those of generateToolpath, except along
/// the border, so that nothing of it shows through them. It takes about as long as
/// generateToolpath.
/// \return the errors of generateToolpath.
Result<ToolpathResult> generateAcross(const PlateInput& input, const ToolpathParams& params,
                                      const RunContext& run);

// Plates made one after the other, as while somebody edits: what the next one needs again is kept.

/// Makes toolpaths again and again, and makes only what has changed. It keeps the fields that
/// depend on the shape (some 17 bytes a cell), the path before its widths (some 16 more) and copies
/// of their inputs. Whatever changed is made anew, so that results are those of generateToolpath,
/// to the byte. Nothing is kept of a plate of more than 40 million cells (3.2 million where
/// pointers have 32 bits). Only one call may run at a time. A session that was moved from may only
/// be assigned to or destroyed.
class Session {
 public:
  Session();
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// Does the same as the function of this name.
  Result<ToolpathResult> generateToolpath(const PlateInput& input, const ToolpathParams& params,
                                          const RunContext& run, bool countDislocations = false);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sillon
