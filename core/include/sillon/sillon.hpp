// The whole library, in the order in which a plate is made. Programs that compile often include the headers they need.
#pragma once

// Values that all rooms share.
#include "sillon/base/reasons.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/sentence.hpp"
#include "sillon/base/types.hpp"
#include "sillon/base/version.hpp"
#include "sillon/base/words.hpp"

// What a person may choose.
#include "sillon/settings/input_params.hpp"
#include "sillon/settings/picture_params.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/printer.hpp"
#include "sillon/settings/project.hpp"
#include "sillon/settings/screen_sizes.hpp"
#include "sillon/settings/table.hpp"
#include "sillon/settings/toolpath_params.hpp"

// Shapes and maps, from bytes (Sec. 4).
#include "sillon/geometry/connected_parts.hpp"
#include "sillon/geometry/grid.hpp"
#include "sillon/geometry/keep_thin.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/geometry/signed_distance.hpp"
#include "sillon/input/direction_map.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/input/plate_size.hpp"
#include "sillon/input/svg.hpp"

// The field of waves (Sec. 5.1 to 5.4).
#include "sillon/field/constraints.hpp"
#include "sillon/field/direction_tolerance.hpp"
#include "sillon/field/dislocations.hpp"
#include "sillon/field/line_field.hpp"
#include "sillon/field/phase_field.hpp"
#include "sillon/field/sine_field.hpp"
#include "sillon/field/spacing_field.hpp"

// The toolpath (Sec. 5.4 to 5.6).
#include "sillon/toolpath/bead_gaps.hpp"
#include "sillon/toolpath/bead_width.hpp"
#include "sillon/toolpath/contour.hpp"
#include "sillon/toolpath/relaxation.hpp"
#include "sillon/toolpath/simplify.hpp"
#include "sillon/toolpath/small_cycles.hpp"
#include "sillon/toolpath/stitch.hpp"
#include "sillon/toolpath/thin_features.hpp"

// The way from a project to a plate.
#include "sillon/job/plate.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/project/plate_input.hpp"
#include "sillon/project/project.hpp"

// The toolpath in one call (Alg. 1), and how good the result is.
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/pipeline/session.hpp"
#include "sillon/pipeline/stages.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/quality/picture_measures.hpp"
#include "sillon/report/input_note.hpp"
#include "sillon/report/report.hpp"
#include "sillon/report/warning.hpp"

// G-code out, and any G-code in.
#include "sillon/gcode/bed_fit.hpp"
#include "sillon/gcode/patches.hpp"
#include "sillon/gcode/read_back.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/gcode_reader/examine.hpp"
#include "sillon/gcode_reader/finding.hpp"
#include "sillon/rebrush/edits.hpp"
#include "sillon/rebrush/rebrush.hpp"
#include "sillon/rebrush/relief.hpp"
#include "sillon/rebrush/surfaces.hpp"

// Pictures, drawings and other files.
#include "sillon/export/base_solid.hpp"
#include "sillon/export/gcode_archive.hpp"
#include "sillon/export/svg_drawing.hpp"
#include "sillon/export/zones.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/conflict.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/look/thumbnails.hpp"
#include "sillon/look/tones.hpp"
#include "sillon/look/view_file.hpp"

// Test prints, and printers from the files of other slicers.
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/calibrate/read_photo.hpp"
#include "sillon/printer_import/printer_import.hpp"
