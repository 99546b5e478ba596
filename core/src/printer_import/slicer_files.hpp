// Settings from files of other slicers.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/lines.hpp"
#include "gcode/blocks.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/printer_import/printer_import.hpp"

namespace sillon {

// Readers of each kind of file; importPrinter tells them apart.

inline constexpr std::size_t kMaxSettingsBytes = std::size_t{16} << 20;
inline constexpr std::size_t kMaxBlockBytes = 65'536;  ///< of a start or end block

/// PrusaSlicer's and SuperSlicer's settings, flat or a bundle. \param name  printer of a bundle, as importPrinter.
Result<ImportedPrinter> importIni(std::string_view text, std::string_view name);

/// A JSON file: a preset of Orca or Bambu Studio, or a project of our own.
Result<ImportedPrinter> importJson(std::string_view text);

/// G-code that a slicer made for the printer.
Result<ImportedPrinter> importDonor(std::string_view text);

/// Tells whether a line, trimmed, is where slicers begin a layer.
bool isLayerMark(std::string_view line);

// G-code as slicers spell it: capitals, one blank before each word, no zeros before a command's number.

/// \param line  trimmed. \return the same command in that spelling, with its comment; what is no G, M or T command, or
/// holds text, is left as it is.
std::string spelled(std::string_view line);

/// Tells whether a line is spelled so already, as nearly all lines are.
bool isSpelled(std::string_view line);

// A slicer's settings to a printer: which key is which field, in the words of PrusaSlicer, Orca and Cura.

using SlicerSettings = std::map<std::string, std::string, std::less<>>;  ///< resolved values by the slicer's names

/// Lays what is known of the settings over out.printer, and lists what was read and what could not be.
void takeSettings(const SlicerSettings& settings, ImportedPrinter& out);

/// The note that a bed was assumed, with its size.
ImportNote bedUnknown(const Printer& printer);

/// Keeps one tool's value of lists with a value for each filament, such as "PLA;PETG".
void chooseTool(SlicerSettings& settings, std::size_t tool);

/// Notes placeholders of the blocks that an export would refuse.
void judgeBlocks(ImportedPrinter& out);

/// takeSettings and judgeBlocks on a file of settings alone. \return InvalidFile where nothing in it is known.
Result<ImportedPrinter> printerOfSettings(const SlicerSettings& settings, ImportedPrinter out);

/// Klipper, where the start block has commands that are words with an underline, which no other firmware knows: slicers
/// say "marlin" of it, too.
void recogniseKlipper(ImportedPrinter& out);

// The settings that a block asks for, put into it: an export knows the job, but not the slicer's file.

/// Puts settings in the place of their names in {...} and [...], and blocks such as [start_filament_gcode] where they
/// are called. Names that the job has a value for stay, and so do those that are in neither.
/// \param job  as templateValues gives them.
std::string withSettings(std::string_view block, const SlicerSettings& settings, const std::vector<TemplateValue>& job);

// Words and numbers as slicers write their settings.

/// In quotes, printable ASCII, at most 60 characters of it.
std::string shown(std::string_view text);

/// The first number of "0.4", "0.4,0.4", "500;1250", "7.04172e-15": settings of several tools begin with the first
/// one's. Nothing for a percentage.
std::optional<double> firstNumber(std::string_view text);

/// "0x0,220x0,220x220,0x220"; empty if it is not that.
std::vector<Vec2> readCorners(std::string_view text);

/// PrusaSlicer's and Cura's escapes in one-line texts.
std::string unescaped(std::string_view text);

/// Counts the values of "1250,960" or "PLA;PETG".
std::size_t itemsOf(std::string_view list);

/// The k-th of them without its escapes, or the first where there are fewer.
std::string itemOf(std::string_view list, std::size_t index);

/// "key = value", split at the first equal sign only: values hold them too.
bool splitSetting(std::string_view line, std::string_view& key, std::string_view& value);

// The area of a bed that a plate may use, as Orca's settings tell it.

struct BedArea {
  Bounds bed;       ///< [mm]
  Bounds excluded;  ///< a box within it; empty: none
};

/// Keeps what all of several nozzles reach. \param text  extruder_printable_area: corners of a box for each.
/// \return whether it could be read.
bool reachByAll(std::string_view text, BedArea& area);

/// Strips along whole edges, and an outline that runs along the edges, make the bed smaller; the box around all else is
/// excluded. \param text  bed_exclude_area: corners, four for each of several boxes. \return whether it could be read.
bool exclude(std::string_view text, BedArea& area);

// Compares lines of a printed block with what a template says of them.

bool isCommand(std::string_view line, std::string_view word);

std::string_view firstWord(std::string_view text);

/// Belongs to the print it was made for, and says nothing about ours.
bool isOfOldPrint(std::string_view line);

/// A range of a text [bytes]; end is 0: none.
struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Finds where the lines of a block say the same, one by one and with no command between, as a template's: the same
/// commands with about the same numbers. The slicer knows the plate's edge, a donor tells its beads. \param told  the
/// template with the donor's own values.
Stretch whereSaid(std::string_view done, std::string_view told);

}  // namespace sillon
