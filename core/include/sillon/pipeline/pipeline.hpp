// From shape and directions to the toolpath (Alg. 1), once or again and again.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/field/dislocations.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// From shape and directions to the toolpath: the stages in order, no maths (Alg. 1).

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
  int gapJoints = 0;  ///< joints that cross a gap between solids
  int unjoined = 0;   ///< toolpaths more than parts: no joint to the rest of a part was possible
  std::vector<Vec2> apart;      ///< where those toolpaths lie: middles of their boxes [mm]
  std::int64_t stitchWork = 0;  ///< joints looked at while stitching, see Stitched
  std::vector<StageTime> time;  ///< in order; the sum is the total
  /// Dislocations of the waves, where they were asked for; not in `time`
  std::optional<Dislocations> dislocations;
};

/// \param countDislocations  for measureToolpath, which else makes the waves anew.
/// \return InvalidArgument (which field, its value, its range), EmptyShape, TooLarge or Cancelled.
Result<ToolpathResult> generateToolpath(const PlateInput& input, const ToolpathParams& params,
                                        const RunContext& run, bool countDislocations = false);

/// The path of the layer below: its beads run across those of generateToolpath, except along the
/// border, so that nothing of it shows through them. Takes about as long.
/// \return as generateToolpath.
Result<ToolpathResult> generateAcross(const PlateInput& input, const ToolpathParams& params,
                                      const RunContext& run);

// Plates made one after the other, as while somebody edits: what the next one needs again is kept.

/// Makes toolpaths again and again, and makes only what has changed. It keeps the fields that
/// depend on the shape (some 17 bytes a cell), the path before its widths (some 16 more) and copies
/// of their inputs. Whatever changed is made anew, so that results are those of generateToolpath,
/// to the byte. Of a plate of more than 40 million cells (3.2 million where pointers have 32 bits)
/// nothing is kept. One call at a time. A session that was moved from may only be assigned to or
/// destroyed.
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
