#include "words.hpp"

#include <CLI/Error.hpp>
#include <cmath>

namespace sillon::cli {

void refuse(const std::string& option, const std::string& text, const std::string& wanted) {
  refuse(option + " is \"" + text + "\"; it must be " + wanted);
}

void refuse(const std::string& sentence) { throw CLI::ValidationError(sentence, CLI::ExitCodes::ValidationError); }

std::optional<double> parseNumber(const std::string& text) {
  if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);  // uses the "C" locale, because the program never sets another
  if (end != text.c_str() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void parseInto(const std::string& option, const std::string& text, double& out) {
  const std::optional<double> value = parseNumber(text);
  if (!value) refuse(option, text, "a number");
  out = *value;
}

void parseInto(const std::string& option, const std::string& text, std::optional<double>& out) {
  out.emplace();
  parseInto(option, text, *out);
}

std::optional<Vec2> parsePair(const std::string& text, char separator) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string::npos) return std::nullopt;
  const std::optional<double> x = parseNumber(text.substr(0, middle));
  const std::optional<double> y = parseNumber(text.substr(middle + 1));
  if (!x || !y) return std::nullopt;
  return Vec2{*x, *y};
}

}  // namespace sillon::cli
