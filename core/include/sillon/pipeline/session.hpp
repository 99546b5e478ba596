// Plates made one after the other, as while somebody edits: what the next one needs again is kept.
#pragma once

#include <memory>

#include "sillon/pipeline/pipeline.hpp"

namespace sillon {

/// Keeps the fields that depend on the shape (some 17 bytes a cell) and the path before its widths (some 16 more) from
/// one call to the next, with copies of the inputs they were made of. Whatever changed is made anew, so that results
/// are those of generateToolpath, to the byte. Of a plate of more than 40 million cells (3.2 million where pointers
/// have 32 bits) nothing is kept. One call at a time. A session that was moved from may only be assigned to or
/// destroyed.
class Session {
 public:
  Session();
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// As the function of this name.
  Result<ToolpathResult> generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                          bool countDislocations = false);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sillon
