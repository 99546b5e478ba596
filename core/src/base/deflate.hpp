// Raw deflate data, as zips and PNGs hold it.
#pragma once

#include <string>
#include <string_view>

namespace sillon {

/// Packs bytes, in one way on every machine. \param data  less than 2 GiB.
std::string deflated(std::string_view data);

}  // namespace sillon
