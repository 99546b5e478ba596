// The whole library, in the order in which a plate is made. Programs that are compiled often
// include only the headers they need.
#pragma once

// Values that all rooms share.
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/base/words.hpp"

// Everything a person may choose, and project files.
#include "sillon/project/project.hpp"
#include "sillon/settings/layers.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/project.hpp"
#include "sillon/settings/table.hpp"

// Shapes and maps, from bytes (Sec. 4).
#include "sillon/compose/compose.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/text/text.hpp"

// The way from a project to a plate, or only to its toolpath (Alg. 1), and measures of the result.
#include "sillon/job/plate.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/report.hpp"
#include "sillon/report/warning.hpp"

// G-code: Sillon's own is written, and any G-code is read.
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/rebrush/rebrush.hpp"

// Pictures, drawings and other files.
#include "sillon/export/export.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/look/preview.hpp"

// Test prints, and import of printers from the files of other slicers.
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/printer_import/printer_import.hpp"
