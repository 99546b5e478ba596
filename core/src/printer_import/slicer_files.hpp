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
#include "export/packing.hpp"
#include "gcode/blocks.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/printer_import/printer_import.hpp"

namespace sillon {

// Readers of each kind of file; importPrinter tells them apart.

inline constexpr std::size_t kMaxSettingsBytes = std::size_t{16} << 20;  ///< greatest size of a file's settings [bytes]
inline constexpr std::size_t kMaxBlockBytes = 65'536;  ///< greatest size of a start or end block [bytes]

/// Reads settings of PrusaSlicer or SuperSlicer, flat or a bundle. \param name  printer of a bundle, as for
/// importPrinter.
Result<ImportedPrinter> importIni(std::string_view text, std::string_view name);

/// Reads a JSON file: a preset of Orca or Bambu Studio, a definition of Cura, or a project of our own.
Result<ImportedPrinter> importJson(std::string_view text);

/// Reads G-code that a slicer made for the printer.
Result<ImportedPrinter> importDonor(std::string_view text);

/// Tells whether a line, trimmed, is a mark by which slicers begin a layer.
bool isLayerMark(std::string_view line);

// Spelling of G-code by slicers: capitals, one blank before each word, no zeros before a command's number.

/// Spells a command as slicers do. \param line  trimmed. \return the same command with its comment; a line that is no
/// G, M or T command, or holds text, is returned unchanged.
std::string spelled(std::string_view line);

/// Tells whether a line is spelled like that already, as nearly all lines are.
bool isSpelled(std::string_view line);

// Conversion of a slicer's settings to a printer, by the keys of PrusaSlicer, Orca and Cura.

using SlicerSettings = std::map<std::string, std::string, std::less<>>;  ///< resolved values by the slicer's names

/// Writes the known settings into out.printer, and lists what was read and what could not be.
void takeSettings(const SlicerSettings& settings, ImportedPrinter& out);

/// Makes the note that a bed was assumed, with its size.
ImportNote bedUnknown(const Printer& printer);

/// Keeps one tool's value of lists with a value for each filament, such as "PLA;PETG".
void chooseTool(SlicerSettings& settings, std::size_t tool);

/// Notes placeholders of the blocks that an export would refuse.
void judgeBlocks(ImportedPrinter& out);

/// Makes the printer of a file of settings alone, by takeSettings and judgeBlocks, with the heating that its start
/// block lacks. \return InvalidFile if no setting is known.
Result<ImportedPrinter> printerOfSettings(const SlicerSettings& settings, ImportedPrinter out);

/// Sets the flavour to Klipper if the start block has commands that are words with an underscore, which no other
/// firmware knows. Slicers call Klipper "marlin", too.
void recogniseKlipper(ImportedPrinter& out);

// Settings that a block asks for are put into it, since an export knows the job, but not the slicer's file.

/// Replaces the names of settings in {...} and [...] with their values, and names of blocks, such as
/// [start_filament_gcode], with the blocks. Names that the job has a value for stay, and so do unknown ones.
/// \param job  values of the job, from templateValues.
std::string withSettings(std::string_view block, const SlicerSettings& settings, const std::vector<TemplateValue>& job);

// Words and numbers as slicers write their settings.

/// Text as a sentence shows it: in quotes, printable ASCII, at most 60 characters of it.
std::string shown(std::string_view text);

/// Reads the first number of "0.4", "0.4,0.4", "500;1250", "7.04172e-15": settings of several tools begin with the
/// first one's. Nothing for a percentage.
std::optional<double> firstNumber(std::string_view text);

/// Reads corners such as "0x0,220x0,220x220,0x220" [mm]; empty if the text is something else.
std::vector<Vec2> readCorners(std::string_view text);

/// Resolves the quotes and escapes that PrusaSlicer and Cura use in one-line texts.
std::string unescaped(std::string_view text);

/// Counts the values of "1250,960" or "PLA;PETG".
std::size_t itemsOf(std::string_view list);

/// Value number `index` of such a list without its escapes, or the first if there are fewer.
std::string itemOf(std::string_view list, std::size_t index);

/// Splits "key = value" at the first equal sign only, since values hold them, too. \return false: the line has no key.
bool splitSetting(std::string_view line, std::string_view& key, std::string_view& value);

// Area of a bed that a plate may use, by Orca's settings.

/// Usable area of a bed.
struct BedArea {
  Bounds bed;       ///< box of the bed [mm]
  Bounds excluded;  ///< a box within it; empty: none
};

/// Reduces the bed to what all of several nozzles reach. \param text  extruder_printable_area: corners of a box for
/// each. \return false: it could not be read.
bool reachByAll(std::string_view text, BedArea& area);

/// Excludes parts of the bed. Strips along whole edges, and an outline that runs along the edges, make the bed smaller;
/// the box around all else is excluded. \param text  bed_exclude_area: corners, four for each of several boxes.
/// \return false: it could not be read.
bool exclude(std::string_view text, BedArea& area);

// Comparison of the lines of a printed block with its template.

/// Tells whether a line is this command, with words or without.
bool isCommand(std::string_view line, std::string_view word);

/// Text up to the first blank.
std::string_view firstWord(std::string_view text);

/// Tells whether a line concerns only the print that it was made for: its progress, its objects, its layers.
bool isOfOldPrint(std::string_view line);

/// Finds the lines of a block that say the same as a template's, one by one and with no command between: the same
/// commands with about the same numbers, since the slicer knows the plate's edge, but a donor shows its beads alone.
/// \return none where the block lacks them. \param done  the block. \param told  the template with the donor's own
/// values.
TextRange whereSaid(std::string_view done, std::string_view told);

}  // namespace sillon
