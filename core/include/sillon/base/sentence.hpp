// Sentences of the core by codes: English is made from them, and other languages translate them by
// their codes.
#pragma once

namespace sillon {

/// One sentence, with placeholders for its values.
struct Sentence {
  const char* code;
  /// English in ASCII, without a full stop. {name} stands for a value; a setting is named in full,
  /// as printer.maxFlow.
  const char* text;
  /// Names of values that come along but are not said, separated by spaces
  const char* unsaid = "";
};

}  // namespace sillon
