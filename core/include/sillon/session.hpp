// Plates made one after the other, as while somebody edits: what the next one needs again is kept.
#pragma once

#include <memory>

#include "sillon/pipeline.hpp"
#include "sillon/preview.hpp"

namespace sillon {

/// Keeps the fields that depend on the shape (some 17 bytes a cell), those of its waves (some 27 more) and the
/// preview's waves (4) from one call to the next, with copies of the inputs they were made of. Whatever changed is made
/// anew, so that results are those of generateToolpath, to the byte. Of a plate with more than 0.4 of the most cells
/// nothing is kept. One call at a time.
class Session {
 public:
  Session();
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// As the function of this name.
  Result<Plate> generateToolpath(const PlateInput& input, const ToolpathParams& params, const RunContext& run,
                                 bool countDislocations = false);

  /// The waves themselves, before any path: bright ridges where beads will lie, black outside. For showing an edit at
  /// once: aligned down to cells of one spacing instead of half of one, along lines that do not give way (lineGive),
  /// and so a few beads begin or end elsewhere than in the plate. The same picture whatever was called before.
  /// \param width  of the picture [pixels], 16..8192; the height follows the page.
  /// \return as generateToolpath, and InvalidArgument for the width.
  Result<RgbImage> previewWaves(const PlateInput& input, const ToolpathParams& params, int width,
                                const RunContext& run);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sillon
