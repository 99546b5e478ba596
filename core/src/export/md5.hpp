// MD5, which Bambu's firmware checks.
#pragma once

#include <string>
#include <string_view>

namespace sillon {

/// RFC 1321, in upper case.
std::string md5(std::string_view text);

}  // namespace sillon
