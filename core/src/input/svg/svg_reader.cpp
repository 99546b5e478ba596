#include "input/svg/svg_reader.hpp"

namespace sillon::svg {

void refuse(const std::string& problem) { throw Refused{ErrorCode::InvalidFile, problem}; }
void refuseTooLarge(const std::string& problem) { throw Refused{ErrorCode::TooLarge, problem}; }

std::string quoted(std::string_view text) {
  std::string copy(text.substr(0, 40));
  for (char& c : copy) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "\"" + copy + (text.size() > 40 ? "...\"" : "\"");
}

void Reader::fail(const std::string& expected) const {
  if (at_ >= text_.size()) refuse(what_ + " ends where " + expected + " must follow");
  refuse(what_ + " has " + quoted(rest()) + " where " + expected + " must stand");
}

}  // namespace sillon::svg
