// The look of a plate for the printer's screen.
#pragma once

#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/screen_sizes.hpp"

namespace sillon {

/// Pictures for PrintParams::thumbnails. \param screenSizes  as readThumbnailSizes. \param page  [mm].
/// \return as readThumbnailSizes and renderLook.
Result<std::vector<Thumbnail>> lookThumbnails(const Toolpath& toolpath, Vec2 page, std::string_view screenSizes,
                                              const LookParams& look, const RunContext& run);

}  // namespace sillon
