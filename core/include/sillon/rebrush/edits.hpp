// A text with some of its bytes changed and all others kept.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sillon {

/// Bytes of a text that become others.
struct Edit {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

/// The text with its edits, in parts that point into both: a large one need not be held twice. \param edits  in the
/// order of the text, disjoint.
std::vector<std::string_view> partsOf(std::string_view text, const std::vector<Edit>& edits);

/// The same at once.
std::string withEdits(std::string_view text, const std::vector<Edit>& edits);

}  // namespace sillon
