// Errors as values: nothing throws out of the core but std::bad_alloc, where the system has no more
// memory.
#pragma once

#include <cassert>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sillon/base/sentence.hpp"

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

/// A number, or a word where `text` is not empty: the name of a setting, or what a reader of a file
/// says.
struct NamedValue {
  NamedValue(const char* named, double value) : name(named), number(value) {}
  NamedValue(const char* named, std::string value) : name(named), text(std::move(value)) {}

  const char* name;
  double number = 0;
  std::string text;
};

struct Error {
  ErrorCode code = ErrorCode::Internal;
  std::string message;  ///< one English sentence: what, which value, which range is allowed
  /// Name of the sentence in sillon::reason, for other languages; empty: it is English alone
  const char* reason = "";
  std::vector<NamedValue> values = {};  ///< of the reason
};

/// A value or an Error; std::expected where the standard library has none yet.
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

/// Why a job is refused, as codes: what `Error::reason` may be, for those who say it in another
/// language than English. Besides: the name of a warning (report/warning.hpp) that is no mere
/// warning here, with its values.
namespace sillon::reason {

/// A number of a project: `setting` ("print.layerHeight"), `value`, `low`, `high`, in the setting's
/// own unit.
inline constexpr char kSettingOutOfRange[] = "SettingOutOfRange";
/// The plate on the bed: `left`, `right`, `front`, `back`: by how much it lies over that edge [mm];
/// those that it does.
inline constexpr char kOverBedEdge[] = "OverBedEdge";
/// On a round bed: `by` [mm].
inline constexpr char kOverRoundBed[] = "OverRoundBed";
/// The plate touches the part of the bed that the printer's profile excludes.
inline constexpr char kOnExcludedZone[] = "OnExcludedZone";
/// The job with its lift: `height`, and `most`, which the printer reaches [mm].
inline constexpr char kTooHigh[] = "TooHigh";
/// Several plates on one bed: `height`, and `most`, at which the print head passes over the others
/// [mm].
inline constexpr char kCopiesTooHigh[] = "CopiesTooHigh";
/// No bead fits anywhere: `spacing` [mm].
inline constexpr char kNoBeadFits[] = "NoBeadFits";
/// The same of a drawing in which nothing is filled: `spacing` [mm].
inline constexpr char kLinesTooThin[] = "LinesTooThin";
/// A hole that cuts nothing: `n`, counted from 1; `x`, `y` and `diameter` [mm]; `left`, `bottom`,
/// `right` and `top` of the shape [mm].
inline constexpr char kHoleOutside[] = "HoleOutside";
/// An offset inwards that leaves nothing: `offset`, and `depth` of the shape's deepest place [mm].
inline constexpr char kOffsetTooDeep[] = "OffsetTooDeep";
/// A text or a drawing: `letter` that no font has.
inline constexpr char kMissingLetter[] = "MissingLetter";
/// A text: `letter` of which its `font` has a picture alone.
inline constexpr char kPictureLetter[] = "PictureLetter";
/// A bundle of printers of which none is chosen: `count`, and their `names` in quotes.
inline constexpr char kWhichPrinter[] = "WhichPrinter";
/// The oriented side lies on the bed: `rim` [layers], which would stand on it.
inline constexpr char kRimBelow[] = "RimBelow";
/// More cells than there may be: `spacing` [mm]; `leastSpacing` [mm] and `percent` of the size, at
/// which it would do, each where there is one.
inline constexpr char kPlateTooLarge[] = "PlateTooLarge";

}  // namespace sillon::reason

namespace sillon {

/// The sentences of reasons whose errors say nothing else.
std::span<const Sentence> reasonSentences();

/// Hints against most errors of a code, by its name. Codes whose messages say it themselves have
/// none.
std::span<const Sentence> errorHints();

}  // namespace sillon
