// The JSON library, as all of core uses it.
#pragma once

// Its checks of itself are for its authors. In the web's engine they would be a quarter of its code.
#if defined(__EMSCRIPTEN__) && !defined(JSON_ASSERT)
#define JSON_ASSERT(x) (static_cast<void>(0))
#endif

#include <nlohmann/json.hpp>

namespace sillon {

using Json = nlohmann::json;  // sorted keys: look-up stays fast in files made of keys only

}  // namespace sillon
