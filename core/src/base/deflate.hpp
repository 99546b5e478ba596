// Raw deflate data, the form in which zips and PNGs store it.
#pragma once

#include <string>
#include <string_view>

namespace sillon {

/// Packs bytes, with the same result on every machine. \param data  less than 2 GiB.
std::string deflated(std::string_view data);

}  // namespace sillon
