#include "input/svg/svg_reader.hpp"

namespace sillon::svg {

void refuse(Reason reason, std::initializer_list<ToldValue> values) { throw Refused{refusedFile(reason, values)}; }
void refuseTooLarge(Reason reason, std::initializer_list<ToldValue> values) {
  throw Refused{refused(ErrorCode::TooLarge, reason, values)};
}

std::string quoted(std::string_view text) {
  std::string copy(text.substr(0, 40));
  for (char& c : copy) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "\"" + copy + (text.size() > 40 ? "...\"" : "\"");
}

std::int64_t lineAt(std::string_view text, std::size_t offset) {
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n');
}

Error notXml(std::string_view text, std::size_t at) {
  return refusedFile("SvgNotXml",
                     {{"line", lineAt(text, at)}, {"text", quoted(text.substr(std::min(at, text.size())))}});
}

void Reader::fail(Reason reason) const { refuse(reason, {{"attribute", what_}, {"text", quoted(rest())}}); }

}  // namespace sillon::svg
