// Raw deflate data, the form in which zip files store it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sillon {

/// Unpacks raw deflate data.
/// \param size  size of the unpacked data [bytes]; the caller bounds it.
/// \return nothing if the data is damaged or of another size.
std::optional<std::string> inflated(std::string_view data, std::size_t size);

}  // namespace sillon
