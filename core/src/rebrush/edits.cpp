#include "sillon/rebrush/rebrush.hpp"

namespace sillon {

std::vector<std::string_view> partsOf(std::string_view text, const std::vector<Edit>& edits) {
  std::vector<std::string_view> parts;
  parts.reserve(2 * edits.size() + 1);
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    parts.push_back(text.substr(at, edit.begin - at));
    parts.push_back(edit.text);
    at = edit.end;
  }
  parts.push_back(text.substr(at));
  return parts;
}

std::string withEdits(std::string_view text, const std::vector<Edit>& edits) {
  const std::vector<std::string_view> parts = partsOf(text, edits);
  std::size_t size = 0;
  for (const std::string_view part : parts) size += part.size();
  std::string out;
  out.reserve(size);
  for (const std::string_view part : parts) out += part;
  return out;
}

}  // namespace sillon
