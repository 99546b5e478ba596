// Effects of owners' and makers' macros, as far as their names and parameters show them.
#pragma once

#include <string>
#include <string_view>

#include "gcode_reader/parser.hpp"

namespace sillon {

/// Copies a text with a-z in upper case.
std::string upperCase(std::string_view text);

/// Reads each KEY=value behind a command. \param take  called with the key in upper case and the value as written,
/// which is a view into `rest`, without quotes.
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

/// Reads each KEY=value whose value begins with a number. \param take  called with the key in upper case and the
/// number.
template <class Take>
void forEachNumber(std::string_view rest, Take&& take) {
  forEachParameter(rest, [&](const std::string& key, std::string_view text) {
    double value = 0;
    if (readNumber(text, value) > 0) take(key, value);
  });
}

/// Tells whether a command starts a print, homing and heating: PRINT_START, START_PRINT, BEGIN_PRINT and the like;
/// G9111 of Anycubic's printers; M98 with a file for the start.
bool isStartMacro(const GcodeCommand& command);

/// Tells whether a command ends a print: PRINT_END, END_PRINT and the like.
bool isEndMacro(const GcodeCommand& command);

/// Axes that a macro homes according to its name, such as CG28 or HOME_ALL; bits of machine.hpp, 0: none.
unsigned homedByMacro(const GcodeCommand& command);

/// Heater that a parameter of a start macro sets.
enum class MacroHeat {
  None,
  Nozzle,       ///< nozzle in the first layer: EXTRUDER, HOTEND_TEMP, ...
  NozzleLater,  ///< nozzle in the layers above the first
  Bed,
};

/// Tells which heater a parameter sets. \param key  in upper case.
MacroHeat macroHeat(std::string_view key);

/// Temperatures of the first layer that a start macro is given [degrees Celsius], 0: not given.
struct MacroTargets {
  double nozzle = 0;
  double bed = 0;
};
/// Reads the temperatures in a start macro's parameters.
MacroTargets macroTargets(std::string_view parameters);

}  // namespace sillon
