// Raw deflate data, as zips hold it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sillon {

/// \param size  of what comes out, which the caller bounds.
/// \return nothing if the data is damaged or of another size.
std::optional<std::string> inflated(std::string_view data, std::size_t size);

}  // namespace sillon
