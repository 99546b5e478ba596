#include "base/refused.hpp"

#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "base/sentence.hpp"

namespace sillon {
namespace {

constexpr Sentence kHints[] = {
    {"TooLarge", "use a larger toolpath.spacing, a smaller size or smaller pictures"},
    {"EmptyShape",
     "the shape needs filled areas wider than a bead; convert text and lines to paths, or make small shapes larger"},
    {"DoesNotFit",
     "make the print smaller, rotate or centre it, print fewer copies or layers, or choose another printer"},
    {"OutOfMemory", "use a larger toolpath.spacing or a smaller size, or close what else needs memory"},
};

}  // namespace

std::span<const Sentence> reasonSentences() { return kReasons; }

std::span<const Sentence> errorHints() { return kHints; }

Error refused(ErrorCode code, Reason reason, std::initializer_list<ToldValue> values) {
  const Sentence& sentence = kReasons[reason.row];
  Error error{code, {}, sentence.code, {}};
  error.values.reserve(values.size());
  for (const ToldValue& value : values) {
    NamedValue& named = error.values.emplace_back(value.name, value.number);
    named.text = value.text;
  }
  error.message = filled(sentence, error.values);
  return error;
}

Error refusedArgument(Reason reason, std::initializer_list<ToldValue> values) {
  return refused(ErrorCode::InvalidArgument, reason, values);
}

Error refusedFile(Reason reason, std::initializer_list<ToldValue> values) {
  return refused(ErrorCode::InvalidFile, reason, values);
}

Error fileTooLarge(std::size_t size, std::size_t most) {
  constexpr std::size_t kMebibyte = std::size_t{1} << 20;
  const std::size_t megabytes = size / kMebibyte + (size % kMebibyte == 0 ? 0 : 1);
  return refused(ErrorCode::TooLarge, "FileTooLarge", {{"megabytes", megabytes}, {"most", most / kMebibyte}});
}

Error needsMoreMemory() { return refused(ErrorCode::TooLarge, "NeedsMoreMemory"); }

Error outOfRange(std::string_view name, double value, double low, double high, const char* unit) {
  const std::string space = *unit == '\0' ? "" : " ";
  const std::string message = std::string(name) + " is " + shownNumber(value) + space + unit + "; it must be " +
                              shownNumber(low) + " to " + shownNumber(high) + space + unit;
  std::vector<NamedValue> values{{"setting", std::string(name)}, {"value", value}, {"low", low}, {"high", high}};
  if (*unit != '\0') values.emplace_back("unit", std::string(unit));
  return {ErrorCode::InvalidArgument, message, reason::kSettingOutOfRange, std::move(values)};
}

Error inPlace(Error error, std::string_view place) {
  error.message.insert(0, std::string(place) + ": ");
  error.values.emplace_back("place", std::string(place));
  return error;
}

}  // namespace sillon
