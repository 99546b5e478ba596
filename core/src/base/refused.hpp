// Errors whose sentence stands in a list.
#pragma once

#include <vector>

#include "sillon/base/result.hpp"

namespace sillon {

/// \param reason  one of reasonSentences(). \param values  of its sentence
Error refused(ErrorCode code, const char* reason, std::vector<NamedValue> values = {});

}  // namespace sillon
