// The version, one place for people and files.
#pragma once

namespace sillon {
inline constexpr const char* kVersion = "0.1.0";
}
