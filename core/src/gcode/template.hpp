// Start and end blocks of the user's: text with placeholders, as slicers have them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gcode/expression.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// What blocks may ask for, by the names of PrusaSlicer, Orca, Cura and IceSL. \param beads  box around all beads [mm].
std::vector<TemplateValue> templateValues(const Printer& printer, const PrintParams& params, const Bounds& beads);

/// Puts values in the place of {expression}, [name], [name[0]] and <NAME>, and leaves out what {if}, {elsif}, {else}
/// and {endif} say. In comments what has no value stays as it is. Lines become printable ASCII without trailing blanks,
/// each ended by LF, and as many as before. \param block  how messages call the text. \return InvalidArgument with the
/// line and what was left in it.
Result<std::string> expandTemplate(std::string_view text, const std::vector<TemplateValue>& values,
                                   std::string_view block);

}  // namespace sillon
