// Words for messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sillon {

/// Text from a file, fit to be shown: in quotes, on one line, at most 60 bytes.
std::string inQuotes(std::string_view text);

/// A letter and its code, fit to be shown: "e" (U+0065).
std::string letterWithCode(std::string_view letter);

/// The nearest of the known names, at most three, the nearest first: those that contain the word,
/// then those that a few letters more, fewer or other make of it.
std::vector<std::string> nearNames(std::string_view word, const std::vector<std::string>& known);

/// "did you mean ...?" with the nearest names, or "known are ..." with all if none is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace sillon
