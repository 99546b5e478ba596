// The words CSS knows for colours.
#pragma once

#include <string_view>

namespace sillon::svg {

/// Whether CSS has a colour of this name, of the system's colours too. \param name  in lower case.
bool isColorName(std::string_view name);

}  // namespace sillon::svg
