#include "webp.hpp"

namespace sillon::cli {

bool writesWebp() { return false; }

Result<std::string> encodeWebp(const std::vector<WebpFrame>& /*frames*/, int /*quality*/, const RunContext& /*run*/) {
  return Error{ErrorCode::Internal, "this build has no libwebp"};
}

}  // namespace sillon::cli
