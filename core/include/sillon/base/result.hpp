// Errors as values: nothing throws out of the core but std::bad_alloc, where the system has no more
// memory.
#pragma once

#include <cassert>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sillon {

/// Kinds of errors.
enum class ErrorCode {
  InvalidArgument,  ///< a parameter is outside its range
  InvalidFile,      ///< the bytes are not what their format promises
  TooLarge,         ///< the job would need more than the limits allow
  OutOfMemory,      ///< the job would need more memory than there is
  EmptyShape,       ///< there is nothing to fill
  DoesNotFit,       ///< the plate is larger than the printer's bed
  Cancelled,        ///< RunContext::requestCancel was called
  Internal,         ///< a defect of Sillon itself
};

/// A named value of a message: the word `text`, such as the name of a setting or what a reader of a
/// file says, if it is not empty, and otherwise `number`.
struct NamedValue {
  NamedValue(const char* named, double value) : name(named), number(value) {}
  NamedValue(const char* named, std::string value) : name(named), text(std::move(value)) {}

  const char* name;
  double number = 0;
  std::string text;
};

/// A failure: its code, an English message, and the parts from which other languages make theirs.
struct Error {
  ErrorCode code = ErrorCode::Internal;
  std::string message;  ///< one English sentence: the fault, its value, and the allowed range
  /// Code of the sentence, for other languages: of sillon::reason or reasonSentences(), or the name
  /// of a warning (report/warning.hpp) that stops this job
  const char* reason = "";
  std::vector<NamedValue> values = {};  ///< values that the reason's sentence names
};

/// A value or an Error; a stand-in for std::expected, which some standard libraries still lack.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT(google-explicit-constructor)
  Result(Error error)
      : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

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

/// Codes of reasons whose errors say more than one sentence. The others stand in reasonSentences().
namespace sillon::reason {

/// A number of a project is out of range. Values: the name of the `setting` ("print.layerHeight"),
/// and its `value`, `low` and `high` in the setting's own unit.
inline constexpr char kSettingOutOfRange[] = "SettingOutOfRange";
/// The plate lies over an edge of the bed. Values: `left`, `right`, `front` and `back`, the length
/// that lies over that edge [mm]; edges that it does not cross are left out.
inline constexpr char kOverBedEdge[] = "OverBedEdge";
/// The plate needs more cells than there may be. Values: `spacing` [mm]; `leastSpacing` [mm] and
/// `percent` of the size, with which it would do, each where there is one.
inline constexpr char kPlateTooLarge[] = "PlateTooLarge";

}  // namespace sillon::reason

namespace sillon {

/// One sentence of the core by its code. English is made from it, and other languages translate it
/// by the code.
struct Sentence {
  const char* code;
  /// English in ASCII, without a full stop. {name} stands for a value; a setting is named in full,
  /// as printer.maxFlow.
  const char* text;
  /// Names of values that come along but are not said, separated by spaces
  const char* unsaid = "";
};

/// Returns the sentences of the reasons whose errors say nothing else. Their placeholders are the
/// names of the values; lengths are in mm.
std::span<const Sentence> reasonSentences();

/// Returns hints on how to avoid most errors of a code, by the name of the code. Codes whose
/// messages say it themselves have none.
std::span<const Sentence> errorHints();

}  // namespace sillon
