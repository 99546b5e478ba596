// The version that people and files are told, kept in one place.
#pragma once

namespace sillon {
inline constexpr const char* kVersion = "0.1.0";
}
