// How a job ends that was asked to stop.
#pragma once

#include "sillon/base/result.hpp"

namespace sillon {

/// ErrorCode::Cancelled.
Error cancelledRun();

}  // namespace sillon
