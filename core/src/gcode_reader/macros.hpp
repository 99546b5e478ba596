// What owners' and makers' macros do, as far as their names and parameters tell it.
#pragma once

#include <string>
#include <string_view>

#include "gcode_reader/parser.hpp"

namespace sillon {

std::string upperCase(std::string_view text);

/// Each KEY=value behind a command. \param take  called with the key in upper case and the value as written, which is a
/// view into `rest`, without quotes.
template <class Take>
void forEachParameter(std::string_view rest, Take&& take) {
  for (std::size_t equal = rest.find('='); equal != std::string_view::npos; equal = rest.find('=', equal + 1)) {
    const std::size_t blank = rest.find_last_of(" \t", equal);
    const std::size_t key = blank == std::string_view::npos ? 0 : blank + 1;
    const std::size_t begin = rest.find_first_not_of(" \t", equal + 1);
    if (begin == std::string_view::npos) return;
    const bool quoted = rest[begin] == '"' || rest[begin] == '\'';
    const std::string_view value = rest.substr(begin + (quoted ? 1 : 0));
    take(upperCase(rest.substr(key, equal - key)),
         value.substr(0, quoted ? value.find(rest[begin]) : value.find_first_of(" \t")));
  }
}

/// Those that are numbers.
template <class Take>
void forEachNumber(std::string_view rest, Take&& take) {
  forEachParameter(rest, [&](const std::string& key, std::string_view text) {
    double value = 0;
    if (readNumber(text, value) > 0) take(key, value);
  });
}

/// PRINT_START, START_PRINT, BEGIN_PRINT and their kin, which home and heat; G9111 of Anycubic's printers; M98 with a
/// file that begins a print.
bool isStartMacro(const GcodeCommand& command);

/// PRINT_END, END_PRINT and their kin.
bool isEndMacro(const GcodeCommand& command);

/// The axes that a macro homes by its name, CG28 and HOME_ALL among them, as machine.hpp counts axes; 0: none.
unsigned homedByMacro(const GcodeCommand& command);

/// What a start macro's parameter sets.
enum class MacroHeat {
  None,
  Nozzle,       ///< EXTRUDER, HOTEND_TEMP, ...
  NozzleLater,  ///< of the layers above the first
  Bed,
};

/// \param key  in upper case.
MacroHeat macroHeat(std::string_view key);

/// The temperatures of the first layer that a start macro is given [degrees Celsius], 0: not told.
struct MacroTargets {
  double nozzle = 0;
  double bed = 0;
};
MacroTargets macroTargets(std::string_view parameters);

}  // namespace sillon
