// The look of a plate for the printer's screen.
#pragma once

#include <string_view>
#include <vector>

#include "sillon/gcode.hpp"
#include "sillon/result.hpp"
#include "sillon/run_context.hpp"
#include "sillon/types.hpp"

namespace sillon {

struct ThumbnailSize {
  int width = 0;   ///< [pixels], 16..1024
  int height = 0;  ///< [pixels], 16..1024
  ThumbnailFormat format = ThumbnailFormat::Png;
};

/// Reads Printer::screenSizes, the way slicers write it: "16x16/QOI, 313x173/QOI, 380x285/PNG".
/// \return at most 8; InvalidArgument.
Result<std::vector<ThumbnailSize>> readThumbnailSizes(std::string_view text);

/// Pictures for PrintParams::thumbnails. \param screenSizes  as readThumbnailSizes. \param page  [mm].
/// \return as readThumbnailSizes and renderLook.
Result<std::vector<Thumbnail>> lookThumbnails(const Toolpath& toolpath, Vec2 page, std::string_view screenSizes,
                                              const RunContext& run);

}  // namespace sillon
