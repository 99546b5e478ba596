// Reads and writes JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

// Configuration of the JSON library for all of core.

// Its internal assertions only help its authors, and would be a quarter of its code in the web's engine.
#if defined(__EMSCRIPTEN__) && !defined(JSON_ASSERT)
#define JSON_ASSERT(x) (static_cast<void>(0))
#endif

namespace sillon {

using Json = nlohmann::json;  // keys are sorted, so that look-up stays fast in files with very many keys

// The library's parser and writer, compiled once: each file that called them itself would take two seconds more to
// compile.

/// Parses JSON; the result `is_discarded()` if the text is none. Of repeated keys the last one counts.
Json parseJson(std::string_view text);

/// Writes JSON on one line; invalid UTF-8 becomes U+FFFD instead of an exception.
std::string jsonText(const Json& value);

// Functions that write JSON without the JSON library, whose header takes long to compile.

/// Quotes and escapes a text; invalid UTF-8 becomes U+FFFD.
std::string jsonString(std::string_view text);

/// Writes the shortest form that reads back as the same number, in every locale; "null" if it is not finite.
std::string jsonNumber(double value);

}  // namespace sillon
