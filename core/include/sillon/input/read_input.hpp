// Files that a project names, as whoever keeps them hands them over.
#pragma once

#include <functional>
#include <string>
#include <variant>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// An input as it comes: a file's bytes, or a picture decoded elsewhere.
using InputFile = std::variant<std::string, Image>;

/// Hands over the file that a project names.
/// \param what  "shape", "direction picture", "font": for messages.
using ReadInput =
    std::function<Result<InputFile>(const std::string& name, const std::string& what)>;

}  // namespace sillon
