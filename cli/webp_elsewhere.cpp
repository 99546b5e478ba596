#include "webp.hpp"

namespace cli {

bool writesWebp() { return false; }

sillon::Result<std::string> encodeWebp(const std::vector<WebpFrame>& /*frames*/, int /*quality*/,
                                       const sillon::RunContext& /*run*/) {
  return sillon::Error{sillon::ErrorCode::Internal, "this build has no libwebp"};
}

}  // namespace cli
