// The order of letters in a line that may run both ways.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace sillon {

/// A part of a line that runs one way and is written in one script, as shapers take it.
struct TextRun {
  std::size_t begin = 0;  ///< in UTF-16 units
  std::size_t end = 0;
  bool toLeft = false;

  friend bool operator==(const TextRun&, const TextRun&) = default;
};

/// The runs of a line by the Unicode bidirectional algorithm (UAX 9), in the order in which they stand from left to
/// right. The line is a paragraph, whose first strong letter gives its direction. Letters of several scripts, as digits
/// and signs, belong to the run before them. wasm/src/text/text-runs.ts does the same.
std::vector<TextRun> textRuns(std::u16string_view line);

}  // namespace sillon
