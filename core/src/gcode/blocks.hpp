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

/// A placeholder: its names in the various slicers, and its values. {name} stands for the first value, {name[k]} for
/// the k-th.
struct TemplateValue {
  std::vector<std::string_view> names;
  std::vector<std::string> values;
  bool whole = true;  ///< an integer (count, temperature): two of them are divided without a remainder
};

/// The value of `name`, `name[k]` or `name_k`, and whether it is an integer.
struct FoundValue {
  std::string text;
  bool whole = true;
};
/// Looks a placeholder up. \return nothing if it has no value.
std::optional<FoundValue> templateValue(std::string_view name, std::size_t index,
                                        const std::vector<TemplateValue>& values);

/// Evaluates an expression of the macro language of PrusaSlicer, OrcaSlicer and Bambu Studio: numbers,
/// "texts", names with and without an index, + - * / %, comparisons, =~ /pattern/, and, or, not, a ? b : c, min, max,
/// round, int, digits, zdigits, random (always its lower bound), one_of, is_nil, size, empty, interpolate_table.
/// \return nothing if a name has no value here, or the text is no expression.
std::optional<std::string> evaluated(std::string_view expression, const std::vector<TemplateValue>& values);

/// Runs a statement: an expression, or an assignment to a variable of the block, which shows nothing (local a = 1,
/// global a = (1, 2), a = repeat(3, 0), a[0] = 1). \param text  begins with the statement, which is taken off.
/// \param own  variables that the block has set so far; their names point into the text.
std::optional<std::string> statement(std::string_view& text, const std::vector<TemplateValue>& values,
                                     std::vector<TemplateValue>& own);

// Start and end blocks that the user gives: text with placeholders, as in slicers.

/// Lists the values that blocks may ask for, by the names of PrusaSlicer, Orca, Cura and IceSL. \param beads  box
/// around all beads [mm].
std::vector<TemplateValue> templateValues(const Printer& printer, const PrintParams& params, const Bounds& beads);

/// Puts values in the place of {expression}, [name], [name[0]] and <NAME>, runs {statement; statement}, and keeps the
/// branch that {if}, {elsif}, {else} and {endif} select. In comments, placeholders without a value stay as they are.
/// Lines become printable ASCII without trailing blanks, each ended by LF, and as many as before. \param block  how
/// messages call the text. \return InvalidArgument with the line and the placeholder that was left in it.
Result<std::string> expandTemplate(std::string_view text, const std::vector<TemplateValue>& values,
                                   std::string_view block);

// Start and end blocks: their placeholders are replaced, and commands that would harm the printer are refused.

/// Tells whether the start block extrudes filament itself, as the blocks of makers and slicers do to fill the nozzle.
bool primesItself(const Printer& printer, const PrintParams& params, const Bounds& beads);

/// Tells whether a start block calls a macro such as PRINT_START, which homes, heats and may fill the nozzle.
bool runsStartMacro(std::string_view block);

/// Tells whether a start block sets pressure advance above 0 (M900 K, M572 S, SET_PRESSURE_ADVANCE).
bool setsPressureAdvance(std::string_view block);

/// Replaces the placeholders of the user's blocks, checks both blocks and puts them into the job.
/// \param beads  box around all plates, without the skirt. \param last  middle of the last plate.
/// \return InvalidArgument with the line and its fault.
std::optional<Error> addBlocks(GcodeJob& job, Bounds beads, Vec2 last, const Printer& printer,
                               const PrintParams& params);

// The start block, heat and purge before the layers, and the end block.

/// Writes all that leads from a cold printer to a primed nozzle beside the plate.
void writeStart(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params);

/// Lifts the nozzle off the plate, restores the settings of the machine, then writes the end block, or parks and
/// switches all off.
void writeEnd(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params);

}  // namespace sillon
