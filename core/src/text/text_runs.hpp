// Order of the letters in a line that may run both ways.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace sillon {

/// A part of a line that runs one way and is written in one script, as shapers require.
struct TextRun {
  std::size_t begin = 0;  ///< UTF-16 units, also for end
  std::size_t end = 0;
  bool toLeft = false;

  friend bool operator==(const TextRun&, const TextRun&) = default;
};

/// Splits a line into runs by the Unicode bidirectional algorithm (UAX 9), in their order from left to right. The line
/// is a paragraph, and its first strong letter gives the direction. Letters common to several scripts, such as digits
/// and punctuation, belong to the run before them. wasm/src/text/text-runs.ts does the same.
std::vector<TextRun> textRuns(std::u16string_view line);

}  // namespace sillon
