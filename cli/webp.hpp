// Encodes moving pictures with libwebp, if the build has it: webp_here.cpp, or webp_elsewhere.cpp.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"

namespace sillon::cli {

struct WebpFrame {
  RgbImage picture;  ///< all pictures of a loop have one size
  int milliseconds = 0;
};

bool writesWebp();

/// Encodes an endless loop of whole frames, lossy. The bytes depend only on the frames and on libwebp's version.
/// \param quality  0..100.
/// \return TooLarge if memory runs out, or Cancelled.
Result<std::string> encodeWebp(const std::vector<WebpFrame>& frames, int quality, const RunContext& run);

}  // namespace sillon::cli
