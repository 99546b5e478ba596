// Words that people and files are told: the version, quoted names and suggestions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sillon {

/// The version, kept in one place.
inline constexpr const char* kVersion = "0.1.0";

/// Makes text from a file fit to be shown: in quotes, on one line, at most 60 bytes.
std::string inQuotes(std::string_view text);

/// Names a letter and its code, fit to be shown: "e" (U+0065).
std::string letterWithCode(std::string_view letter);

/// Finds at most three known names that are near a word, the nearest first: those that contain the
/// word, then those that differ from it by a few letters.
std::vector<std::string> nearNames(std::string_view word, const std::vector<std::string>& known);

/// Returns "did you mean ...?" with the nearest names, or "known are ..." with all if none is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace sillon
