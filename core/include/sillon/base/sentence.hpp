// Sentences of the core by codes: English is made from them, and other languages translate
// them by their codes.
#pragma once

namespace sillon {

struct Sentence {
  const char* code;
  /// English in ASCII, without a full stop. {name} stands for a value; a setting is named in full,
  /// as printer.maxFlow.
  const char* text;
  const char* unsaid =
      "";  ///< names of values that come along and are not said, with spaces between
};

}  // namespace sillon
