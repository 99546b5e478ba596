// Errors as values: nothing throws out of the core but std::bad_alloc, where the system has no more memory.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace sillon {

enum class ErrorCode {
  InvalidArgument,  ///< a parameter is outside its range
  InvalidFile,      ///< bytes that cannot be read as what they claim to be
  TooLarge,         ///< the job would need more than the limits allow
  OutOfMemory,      ///< the job would need more memory than there is
  EmptyShape,       ///< nothing to fill
  DoesNotFit,       ///< larger than the printer's bed
  Cancelled,        ///< RunContext::requestCancel was called
  Internal,         ///< our fault
};

/// One sentence for people: what, which value, which range is allowed.
struct Error {
  ErrorCode code = ErrorCode::Internal;
  std::string message;
};

/// A value or an Error; std::expected where the standard library has none yet.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  [[nodiscard]] T& value() & {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  [[nodiscard]] const T& value() const& {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  [[nodiscard]] T&& value() && {
    assert(ok());
    return std::move(*std::get_if<0>(&state_));
  }
  [[nodiscard]] const Error& error() const {
    assert(!ok());
    return *std::get_if<1>(&state_);
  }

 private:
  std::variant<T, Error> state_;
};

}  // namespace sillon
