// A text with some of its bytes changed and all others kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sillon {

/// Bytes of a text that become others.
struct Edit {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::string text;
};

/// The text with its edits, piece by piece: a large one need not be held twice. \param edits  in the order of the text,
/// disjoint. \param size  of each piece but the last [bytes], > 0. \param take  may keep nothing of what it is given.
void forEachPiece(std::string_view text, const std::vector<Edit>& edits, std::size_t size,
                  const std::function<void(std::string_view)>& take);

/// The same at once.
std::string withEdits(std::string_view text, const std::vector<Edit>& edits);

}  // namespace sillon
