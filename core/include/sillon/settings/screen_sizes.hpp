// Sizes of the pictures that a printer shows on its screen.
#pragma once

#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/settings/print_params.hpp"

namespace sillon {

struct ThumbnailSize {
  int width = 0;   ///< [pixels], 16..1024
  int height = 0;  ///< [pixels], 16..1024
  ThumbnailFormat format = ThumbnailFormat::Png;
};

/// Reads Printer::screenSizes, the way slicers write it: "16x16/QOI, 313x173/QOI, 380x285/PNG".
/// \return at most 8; InvalidArgument.
Result<std::vector<ThumbnailSize>> readThumbnailSizes(std::string_view text);

}  // namespace sillon
