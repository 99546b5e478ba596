// A picture that a project names.
#pragma once

#include <string>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/project/plate_input.hpp"

namespace sillon {

/// \param what  it is, for messages.
Result<Image> readPicture(const ReadInput& read, const std::string& name, const std::string& what);

}  // namespace sillon
