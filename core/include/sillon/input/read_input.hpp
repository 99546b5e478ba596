// Files that a project names, handed over by whoever keeps them.
#pragma once

#include <functional>
#include <string>
#include <variant>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// An input: the bytes of a file, or a picture decoded elsewhere.
using InputFile = std::variant<std::string, Image>;

/// Hands over the file that a project names.
/// \param what  role of the file, for messages: "shape", "direction picture", "font".
using ReadInput =
    std::function<Result<InputFile>(const std::string& name, const std::string& what)>;

}  // namespace sillon
