// Where the code that changes a tool or a filament begins and ends: it cuts, flushes and wipes in ways of its own.
#pragma once

#include <optional>

#include "gcode_reader/parser.hpp"

namespace sillon {

/// \return true: it begins; false: it ends; nothing: the line is something else. PrusaSlicer's comments, and M620 S and
/// M621 S of Bambu's printers.
inline std::optional<bool> toolChangeMark(const GcodeParts& parts) {
  if (parts.code.empty()) {
    if (parts.comment == "CP TOOLCHANGE START" || parts.comment == "CP PRIMING START") return true;
    const bool ends = parts.comment == "CP TOOLCHANGE END" || parts.comment == "CP PRIMING END";
    return ends ? std::optional(false) : std::nullopt;
  }
  if (!parts.code.starts_with("M62")) return std::nullopt;
  const GcodeCommand command = commandOf(parts.code);
  const bool begins = command.is('M', 620);
  if (!begins && !command.is('M', 621)) return std::nullopt;
  const std::size_t word = command.rest.find_first_not_of(" \t");
  return word != std::string_view::npos && command.rest[word] == 'S' ? std::optional(begins) : std::nullopt;
}

}  // namespace sillon
