#include "input/svg/svg_node.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace sillon::svg {
namespace {

// Checks tags from left to right as RapidXML will read them, but a little more strictly. RapidXML is recursive; the
// check makes sure that its recursion stays shallow.
class NestingCheck {
 public:
  explicit NestingCheck(std::string_view text) : text_(text) {}

  std::vector<std::size_t> run() {
    int depth = 0, textDepth = kMaxDepth + 1;
    while ((at_ = text_.find('<', at_)) != std::string_view::npos) {
      const std::string_view rest = text_.substr(at_);
      if (depth >= textDepth) noteSpace();
      if (startsWith(rest, "<!--")) {
        skipPast("-->", 4);
      } else if (startsWith(rest, "<![CDATA[")) {
        skipPast("]]>", 9);
      } else if (startsWith(rest, "<?")) {
        skipPast("?>", 2);
      } else if (startsWith(rest, "<!DOCTYPE")) {
        at_ += 9;
        skipDoctype();
      } else if (startsWith(rest, "</")) {
        skipPast(">", 2);
        if (--depth < textDepth) textDepth = kMaxDepth + 1;
      } else {
        const std::size_t name = ++at_;
        if (!skipTag()) continue;
        if (++depth > kMaxDepth) {
          refuseTooLarge("SvgNested", {{"most", kMaxDepth}});
        }
        if (isText(text_.substr(name, at_ - name))) textDepth = std::min(depth, textDepth);
      }
    }
    return std::move(spaces_);
  }

 private:
  // Tells whether a tag is that of a <text>, with any prefix.
  static bool isText(std::string_view tag) {
    tag = tag.substr(0, tag.find_first_of(" \t\n\r>"));
    return tag == "text" || tag.ends_with(":text");
  }

  // Records white space that stands alone between two tags; it prefers a position that is no line break.
  void noteSpace() {
    std::size_t begin = at_;
    while (begin > 0 && isSpace(text_[begin - 1])) --begin;
    if (begin == at_ || begin == 0 || text_[begin - 1] != '>') return;
    const std::size_t inLine = text_.substr(begin, at_ - begin).find_first_not_of("\r\n");
    spaces_.push_back(inLine == std::string_view::npos ? begin : begin + inLine);
  }

  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  [[noreturn]] void malformed() const { throw Refused{notXml(text_, at_)}; }

  void skipPast(std::string_view end, std::size_t offset) {
    const std::size_t found = text_.find(end, at_ + offset);
    if (found == std::string_view::npos) malformed();
    at_ = found + end.size();
  }

  void skipDoctype() {
    int brackets = 0;
    for (; peek() != '>' || brackets > 0; ++at_) {
      if (at_ >= text_.size()) malformed();
      if (peek() == '[') ++brackets;
      if (peek() == ']' && brackets > 0) --brackets;
    }
    ++at_;
  }

  void skipSpace() {
    while (isSpace(peek()) && peek() != '\f') ++at_;
  }

  void skipName() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string_view(" \t\n\r/>=").find(text_[at_]) == std::string_view::npos) {
      if (std::string_view("<\"'?!&").find(text_[at_]) != std::string_view::npos) break;
      ++at_;
    }
    if (at_ == begin) malformed();
  }

  // Skips a tag. Returns true if the tag opens an element.
  bool skipTag() {
    skipName();
    skipSpace();
    while (peek() != '>' && peek() != '/') {
      skipName();
      skipSpace();
      if (peek() != '=') malformed();
      ++at_;
      skipSpace();
      const char quote = peek();
      if (quote != '"' && quote != '\'') malformed();
      ++at_;
      skipPast(std::string_view(&quote, 1), 0);
      skipSpace();
    }
    const bool opens = peek() == '>';
    if (!opens) ++at_;
    if (peek() != '>') malformed();
    ++at_;
    return opens;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::size_t> spaces_;
};

}  // namespace

std::string checkNesting(std::string_view text) {
  const std::vector<std::size_t> spaces = NestingCheck(text).run();
  std::string out;
  std::size_t from = 0;
  for (const std::size_t space : spaces) {
    out.append(text, from, space - from) += "&#32;";
    from = space + 1;
  }
  return spaces.empty() ? out : out.append(text, from, std::string_view::npos);
}

}  // namespace sillon::svg
