#include "sillon/rebrush/edits.hpp"

#include <algorithm>

namespace sillon {
namespace {

template <class Take>
void forEachPart(std::string_view text, const std::vector<Edit>& edits, Take&& take) {
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    take(text.substr(at, edit.begin - at));
    take(std::string_view(edit.text));
    at = edit.end;
  }
  take(text.substr(at));
}

}  // namespace

void forEachPiece(std::string_view text, const std::vector<Edit>& edits, std::size_t size,
                  const std::function<void(std::string_view)>& take) {
  std::string piece;
  piece.reserve(size);
  forEachPart(text, edits, [&](std::string_view part) {
    while (!part.empty()) {
      const std::size_t more = std::min(part.size(), size - piece.size());
      piece.append(part.substr(0, more));
      part.remove_prefix(more);
      if (piece.size() < size) continue;
      take(piece);
      piece.clear();
    }
  });
  if (!piece.empty()) take(piece);
}

std::string withEdits(std::string_view text, const std::vector<Edit>& edits) {
  std::size_t size = text.size();
  for (const Edit& edit : edits) size = size + edit.text.size() - (edit.end - edit.begin);
  std::string out;
  out.reserve(size);
  forEachPart(text, edits, [&](std::string_view part) { out += part; });
  return out;
}

}  // namespace sillon
