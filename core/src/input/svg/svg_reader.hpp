// Basics that all readers of SVG share: errors, and reading attributes from left to right.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include <fast_float/fast_float.h>

#include "base/refused.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"

namespace sillon::svg {

/// The SVG reader throws this error inside its own files and catches it before it returns. Parsing nests deeply, so
/// every level would otherwise have to pass errors on.
struct Refused {
  Error error;
};

/// Throws Refused with InvalidFile.
[[noreturn]] void refuse(Reason reason, std::initializer_list<ToldValue> values = {});
[[noreturn]] void refuseTooLarge(Reason reason, std::initializer_list<ToldValue> values = {});

inline bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
inline bool isDigit(char c) { return c >= '0' && c <= '9'; }
inline bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }
inline bool startsWith(std::string_view text, std::string_view head) { return text.substr(0, head.size()) == head; }

inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
  return text;
}

inline std::string lowered(std::string_view text) {
  std::string copy(text);
  std::transform(copy.begin(), copy.end(), copy.begin(), lower);
  return copy;
}

/// Quotes text of the file for a message: shortened, printable characters only.
std::string quoted(std::string_view text);

/// Returns the number of the line at an offset, from 1.
std::int64_t lineAt(std::string_view text, std::size_t offset);

/// Makes the error for a text that is no well-formed XML. \param at  offset of what is wrong
Error notXml(std::string_view text, std::size_t at);

/// Calls body(piece) for each piece between separators.
template <class Body>
void split(std::string_view text, char separator, const Body& body) {
  while (true) {
    const std::size_t end = text.find(separator);
    body(text.substr(0, end));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

/// Reads numbers, flags and words of an attribute from left to right.
class Reader {
 public:
  /// \param what  name of the attribute, for error messages
  Reader(std::string_view text, const char* what) : text_(text), what_(what) {}

  bool atEnd() {
    skipSpace();
    return at_ == text_.size();
  }
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  char take() { return text_[at_++]; }
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }

  void skipSpace() {
    while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
  }
  void skipSeparator() {
    skipSpace();
    if (peek() != ',') return;
    ++at_;
    skipSpace();
  }
  void expect(char c) {
    skipSpace();
    if (peek() != c) refuse("SvgSign", {{"attribute", what_}, {"text", quoted(rest())}, {"sign", std::string(1, c)}});
    ++at_;
  }
  std::string_view word() {
    const std::size_t begin = at_;
    while (isLetter(peek())) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// Reads a finite number; separators before it are skipped.
  double number() {
    skipSeparator();
    std::size_t begin = at_;
    std::size_t first = begin + (peek() == '+' || peek() == '-' ? 1 : 0);
    // fast_float would also accept "inf" and "nan".
    if (first >= text_.size() || !(isDigit(text_[first]) || text_[first] == '.')) fail("SvgNumber");
    if (text_[begin] == '+') begin = first;
    double value = 0;
    const auto [end, error] = fast_float::from_chars(text_.data() + begin, text_.data() + text_.size(), value);
    if (error != std::errc{}) fail("SvgNumber");
    if (!std::isfinite(value)) fail("SvgNumberTooLarge");
    at_ = toSize(end - text_.data());
    return value;
  }

  /// Reads a flag of an arc. Flags may stand without separators: "a1 1 0 0110 10".
  bool flag() {
    skipSeparator();
    if (peek() != '0' && peek() != '1') fail("SvgFlag");
    return take() == '1';
  }

  /// Refuses the text at the current position. \param reason  its message names the attribute and quotes that text
  [[noreturn]] void fail(Reason reason) const;

 private:
  std::string_view text_;
  std::string what_;
  std::size_t at_ = 0;
};

}  // namespace sillon::svg
