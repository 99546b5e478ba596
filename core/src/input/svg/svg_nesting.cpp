#include "input/svg/svg_node.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "input/svg/svg_reader.hpp"

namespace sillon::svg {
namespace {

// Checks tags from left to right as RapidXML will read them, but a little stricter, so that its recursion is known
// to be shallow before it starts.
class NestingCheck {
 public:
  explicit NestingCheck(std::string_view text) : text_(text) {}

  void run() {
    int depth = 0;
    while ((at_ = text_.find('<', at_)) != std::string_view::npos) {
      const std::string_view rest = text_.substr(at_);
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
        --depth;
      } else {
        ++at_;
        if (skipTag() && ++depth > kMaxDepth) {
          refuseTooLarge("the file nests elements deeper than " + std::to_string(kMaxDepth) + " levels");
        }
      }
    }
  }

 private:
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  [[noreturn]] void malformed(const std::string& problem) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size())), '\n');
    refuse("the file is not well-formed XML: " + problem + " in line " + std::to_string(line));
  }

  void skipPast(std::string_view end, std::size_t offset) {
    const std::size_t found = text_.find(end, at_ + offset);
    if (found == std::string_view::npos) malformed("no '" + std::string(end) + "' closes what begins");
    at_ = found + end.size();
  }

  void skipDoctype() {
    int brackets = 0;
    for (; peek() != '>' || brackets > 0; ++at_) {
      if (at_ >= text_.size()) malformed("a DOCTYPE without end");
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
    if (at_ == begin)
      malformed(at_ < text_.size() ? "an unexpected " + quoted(text_.substr(at_, 1)) : "an unfinished tag");
  }

  // Returns whether the tag opens an element.
  bool skipTag() {
    skipName();
    skipSpace();
    while (peek() != '>' && peek() != '/') {
      skipName();
      skipSpace();
      if (peek() != '=') malformed("an attribute without value");
      ++at_;
      skipSpace();
      const char quote = peek();
      if (quote != '"' && quote != '\'') malformed("an attribute without quotes");
      ++at_;
      skipPast(std::string_view(&quote, 1), 0);
      skipSpace();
    }
    const bool opens = peek() == '>';
    if (!opens) ++at_;
    if (peek() != '>') malformed("a '/' without '>'");
    ++at_;
    return opens;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

void checkNesting(std::string_view text) { NestingCheck(text).run(); }

}  // namespace sillon::svg
