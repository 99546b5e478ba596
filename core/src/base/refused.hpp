// Makes errors whose sentence stands in a list.
#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/reasons.hpp"
#include "sillon/base/result.hpp"

namespace sillon {

/// A value of a sentence, as NamedValue, whose text is not copied: it lasts for a call.
struct ToldValue {
  ToldValue(const char* named, double value) : name(named), number(value) {}
  ToldValue(const char* named, std::integral auto value) : name(named), number(static_cast<double>(value)) {}
  ToldValue(const char* named, std::string_view value) : name(named), text(value) {}
  ToldValue(const char* named, const std::string& value) : name(named), text(value) {}
  ToldValue(const char* named, const char* value) : name(named), text(value) {}

  const char* name;
  double number = 0;
  std::string_view text;
};

/// Makes an error with its sentence. \param values  values of its sentence
Error refused(ErrorCode code, Reason reason, std::initializer_list<ToldValue> values = {});

/// Refuses an argument or a setting.
Error refusedArgument(Reason reason, std::initializer_list<ToldValue> values = {});

/// Refuses a file for what it contains.
Error refusedFile(Reason reason, std::initializer_list<ToldValue> values = {});

/// Refuses a file, or what is packed in it, for its size. \param size, most  [bytes]
Error fileTooLarge(std::size_t size, std::size_t most);

/// Refuses a job for which the system has no more memory.
Error needsMoreMemory();

/// Makes the error for a number outside its range, as "shape.offset is 60 mm; it must be -20 to 50 mm".
/// \param name  setting in full, or another name  \param unit  as "mm"; may be empty
Error outOfRange(std::string_view name, double value, double low, double high, const char* unit);

/// Puts the place of a fault, such as a file in quotes, before its sentence.
Error inPlace(Error error, std::string_view place);

}  // namespace sillon
