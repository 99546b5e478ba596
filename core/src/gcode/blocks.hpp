// Start and end blocks of a print.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gcode/job.hpp"
#include "gcode/nozzle.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Expressions in slicers' start and end blocks: {first_layer_temperature[0] - 60}, {if max_layer_z < 100}.

/// A placeholder's names, one per program that people know them from, and its values: {name} is the first, {name[k]}
/// the k-th.
struct TemplateValue {
  std::vector<std::string_view> names;
  std::vector<std::string> values;
  bool whole = true;  ///< counts, temperatures: where no point is written, two of them are divided without a rest
};

/// The value of `name`, `name[k]` or `name_k`, and whether it is a whole one.
struct FoundValue {
  std::string text;
  bool whole = true;
};
/// \return nothing: there is none.
std::optional<FoundValue> templateValue(std::string_view name, std::size_t index,
                                        const std::vector<TemplateValue>& values);

/// The value of an expression as PrusaSlicer's macro language has it, and OrcaSlicer's and Bambu Studio's: numbers,
/// "texts", names with and without an index, + - * / %, comparisons, =~ /pattern/, and, or, not, a ? b : c, min, max,
/// round, int, digits, zdigits, random (the least), one_of, is_nil, size, empty, interpolate_table. Nothing: a name
/// that has no value here, or what is no expression.
std::optional<std::string> evaluated(std::string_view expression, const std::vector<TemplateValue>& values);

/// An expression, or a value of the block's own: local a = 1, global a = (1, 2), a = repeat(3, 0), a[0] = 1, for which
/// nothing is shown. \param text  begins with it; it is taken off. \param own  what the block has set so far; its names
/// point into the text.
std::optional<std::string> statement(std::string_view& text, const std::vector<TemplateValue>& values,
                                     std::vector<TemplateValue>& own);

// Start and end blocks of the user's: text with placeholders, as slicers have them.

/// Values that blocks may ask for, by the names of PrusaSlicer, Orca, Cura and IceSL. \param beads  box around all
/// beads [mm].
std::vector<TemplateValue> templateValues(const Printer& printer, const PrintParams& params, const Bounds& beads);

/// Puts values in the place of {expression}, [name], [name[0]] and <NAME>, runs {statement; statement}, and leaves out
/// what {if}, {elsif}, {else} and {endif} say. In comments what has no value stays as it is. Lines become printable
/// ASCII without trailing blanks, each ended by LF, and as many as before. \param block  how messages call the text.
/// \return InvalidArgument with the line and what was left in it.
Result<std::string> expandTemplate(std::string_view text, const std::vector<TemplateValue>& values,
                                   std::string_view block);

// Start and end blocks: values put in, and what a printer would come to grief at.

/// Whether the start block lays beads of its own: makers' and slicers' blocks fill the nozzle so.
bool primesItself(const Printer& printer, const PrintParams& params, const Bounds& beads);

/// Whether a start block has a macro that homes, heats and may fill the nozzle: PRINT_START and its kin.
bool runsStartMacro(std::string_view block);

/// Whether a start block sets pressure advance above 0 (M900 K, M572 S, SET_PRESSURE_ADVANCE).
bool setsPressureAdvance(std::string_view block);

/// Puts the values into the user's blocks and judges them.
/// \param beads  box around all plates; the skirt is added here. \param last  middle of the last plate.
/// \return InvalidArgument with the line and what is wrong there.
std::optional<Error> addBlocks(GcodeJob& job, Bounds beads, Vec2 last, const Printer& printer,
                               const PrintParams& params);

// The start block, heat and purge before the layers, and the end block.

/// From cold to a primed nozzle beside the plate.
void writeStart(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params);

/// Above the plate: what was changed of the machine goes back, then the end block, or parking and all off.
void writeEnd(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params);

}  // namespace sillon
