// JSON that is written without the JSON library, whose header takes compilers long.
#pragma once

#include <string>
#include <string_view>

namespace sillon {

/// In quotes, escaped; bytes that are no UTF-8 become U+FFFD.
std::string jsonString(std::string_view text);

/// The shortest form that reads back as the same number, in every locale; "null" where it is not finite.
std::string jsonNumber(double value);

}  // namespace sillon
