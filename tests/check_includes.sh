#!/usr/bin/env bash
# Keeps the order of the stages: a file of core includes what it eats and makes, never a later stage, and nothing of
# files, consoles or browsers. Prints each breach as file:line; silent and 0 if there is none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Tools that know no stage. They may include each other only.
foundation="types result run_context params version grid parallel_for fast_math simd hierarchy lines point_grid curves text direction_colour toolpath_check gcode_grammar qoi preset_data stored_zip sort_key triangulate release"

# file: the stages it may include, besides the foundation and its own header.
stages="
shape:
svg_reader:
svg_node: svg_reader
svg_style: svg_node svg_reader
svg_path: shape svg_reader
svg: shape svg_node svg_path svg_reader svg_style
image_io: inflate
direction_map:
outline: shape
sdf: outline
constraints: direction_map sdf
line_field: constraints sdf
spacing_field: constraints line_field
phase_field: line_field sdf
sine_field: phase_field
contour:
parts: sdf
narrow_places: grid
tiny_cycles: sdf
stitch: line_field parts sdf
neighbour_gaps: sdf
kinks: sdf
relaxation: neighbour_gaps kinks sdf
bead_width: neighbour_gaps sdf
simplify: bead_width
line_give: constraints line_field phase_field
wave_fields: constraints direction_map sdf line_field spacing_field phase_field line_give
pipeline: shape direction_map dislocations sdf parts narrow_places tiny_cycles wave_fields sine_field contour stitch relaxation bead_width simplify session wave_preview
session: pipeline preview
wave_preview: phase_field sdf preview
dislocations: constraints line_field phase_field
bead_area: shape outline
measure: direction_map outline sdf constraints wave_fields dislocations bead_area
report: measure pipeline
turned: shape gcode
base_layers: shape outline
motion: gcode
chunked_output: gcode
bed: gcode
bed_fit: shape gcode bed turned
dialect: gcode
offset_loops: shape outline sdf contour base_layers
gcode_coverage:
gcode_check: gcode bed gcode_coverage
gcode_checks: gcode gcode_job
gcode_template: gcode gcode_job
gcode_job: gcode gcode_checks measure bed_fit turned base_layers offset_loops motion bed gcode_template gcode_check
gcode: shape outline motion gcode_job chunked_output bed dialect
gcode_archive: inflate
base_body: shape outline gcode gcode_job gcode_checks turned
presets: gcode
preview: image_io
thumbnails: gcode preview image_io
toolpath_svg: shape
view_file: image_io
project: direction_map gcode pipeline presets thumbnails
printer_import: gcode gcode_archive gcode_template gcode_check project thumbnails
plate_input: shape svg image_io direction_map pipeline project
"

forbidden='iostream|fstream|ostream|istream|filesystem|cstdio|stdio\.h|emscripten.*'

find core -name '*.[ch]pp' -print0 | sort -z |
  xargs -0 grep -nE '^[[:space:]]*#[[:space:]]*include' /dev/null |
  awk -v foundation="$foundation" -v stages="$stages" -v forbidden="^<($forbidden)>\$" '
    function stem(path) { sub(/.*\//, "", path); sub(/\.[ch]pp$/, "", path); return path }
    function breach(text) { print where ": " text; broken = 1 }
    BEGIN {
      n = split(foundation, names, " ")
      for (k = 1; k <= n; ++k) isFoundation[names[k]] = 1
      n = split(stages, lines, "\n")
      for (k = 1; k <= n; ++k) {
        if (split(lines[k], sides, ":") < 2) continue
        known[sides[1]] = 1
        m = split(sides[2], names, " ")
        for (i = 1; i <= m; ++i) may[sides[1], names[i]] = 1
      }
    }
    {
      split($0, part, ":")
      where = part[1] ":" part[2]
      file = stem(part[1])
      header = $0
      sub(/^[^:]*:[^:]*:[^"<]*/, "", header)
      sub(/[^">]*$/, "", header)
      if (header ~ forbidden) breach("core includes no " header)
      if (header !~ /^"/) next
      gsub(/"/, "", header)
      header = stem(header)
      if (!(file in known) && !(file in isFoundation)) { breach(file " has no row in tests/check_includes.sh"); next }
      if (header == file || header in isFoundation || (file, header) in may) next
      breach(file " may not include " header ", see tests/check_includes.sh")
    }
    END { exit broken }'
