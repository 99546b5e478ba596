// The settings that a block asks for, put into it: an export knows the job, but not the slicer's file.
#pragma once

#include <string>
#include <string_view>

#include "gcode/expression.hpp"
#include "printer_import/slicer_settings.hpp"

namespace sillon {

/// Puts settings in the place of their names in {...} and [...], and blocks such as [start_filament_gcode] where they
/// are called. Names that the job has a value for stay, and so do those that are in neither.
/// \param job  as templateValues gives them.
std::string withSettings(std::string_view block, const SlicerSettings& settings, const std::vector<TemplateValue>& job);

}  // namespace sillon
