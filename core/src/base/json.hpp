// JSON, read and written.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

// The JSON library, as all of core uses it.

// Its checks of itself are for its authors. In the web's engine they would be a quarter of its code.
#if defined(__EMSCRIPTEN__) && !defined(JSON_ASSERT)
#define JSON_ASSERT(x) (static_cast<void>(0))
#endif

namespace sillon {

using Json = nlohmann::json;  // sorted keys: look-up stays fast in files made of keys only

// The library's parser and writer, compiled once: each file that calls them itself takes a compiler two seconds more.

/// What the text says; `is_discarded()` where it is no JSON. Of repeated keys the last one counts.
Json parseJson(std::string_view text);

/// On one line; bytes that are no UTF-8 become U+FFFD instead of an exception.
std::string jsonText(const Json& value);

// JSON that is written without the JSON library, whose header takes compilers long.

/// In quotes, escaped; bytes that are no UTF-8 become U+FFFD.
std::string jsonString(std::string_view text);

/// The shortest form that reads back as the same number, in every locale; "null" where it is not finite.
std::string jsonNumber(double value);

}  // namespace sillon
