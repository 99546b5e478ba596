// MD5, which Bambu's firmware checks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sillon {

/// RFC 1321, in upper case.
std::string md5(std::string_view text);

/// The same of a text in parts.
std::string md5(const std::vector<std::string_view>& parts);

}  // namespace sillon
