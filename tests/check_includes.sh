#!/usr/bin/env bash
# Keeps the walls between the rooms of core: a file includes its own room and those that its room's row names, and nothing
# of files, consoles or browsers; a row names no room that nothing of it is included from; sillon.hpp includes all public
# headers. An error names a reason. Prints each breach as file:line; silent and 0 if there is none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# room: the rooms it includes, besides base. A room may name only rooms above it, so there can be no circle.
rooms="
base:
settings:
geometry:
input: settings geometry
field: settings geometry input
toolpath: settings geometry field
look: settings input toolpath
pipeline: settings geometry input field toolpath
quality: settings geometry input field toolpath look pipeline
printer: settings
gcode_reader: settings printer
report: settings geometry look pipeline quality gcode_reader
text: settings geometry input
project: settings geometry input text
pictures: geometry input look pipeline quality project
gcode: settings geometry toolpath quality printer gcode_reader report
calibrate: settings geometry input look pipeline gcode
export: settings geometry input toolpath look gcode_reader gcode
compose: settings geometry input look pipeline quality report text project pictures
rebrush: settings geometry input look pipeline quality gcode_reader project compose
job: settings geometry input look pipeline quality gcode_reader report project pictures gcode export compose
printer_import: settings look gcode_reader project gcode export
"

forbidden='iostream|fstream|ostream|istream|filesystem|cstdio|stdio\.h|emscripten.*'

broken=0
while read -r header; do
  if ! grep -q "^#include \"$header\"" core/include/sillon/sillon.hpp; then
    echo "core/include/sillon/sillon.hpp: does not include $header"
    broken=1
  fi
done < <(cd core/include && find sillon/*/ -name '*.hpp' | sort)

# An error without a reason is said in English whatever the language; base/refused.hpp makes those with one.
find core/src wasm -path '*/node_modules' -prune -o -name '*.[ch]pp' -not -path 'core/src/base/*' -print | sort |
  xargs awk '
    { statement = statement $0 }
    /[;{}]$/ {
      if (statement ~ /(Error|return) ?\{[^=]*ErrorCode::/ && statement !~ /[rR]eason|warningName/) {
        print FILENAME ":" FNR ": an error without a reason, see core/src/base/refused.hpp"
        broken = 1
      }
      statement = ""
    }
    END { exit broken }' || broken=1

# A reason that no error names any more is dead in the tables of three languages.
named=$(find core/src wasm -path '*/node_modules' -prune -o -name '*.[ch]pp' -not -name reasons.hpp -print0 | xargs -0 grep -ohE '"[A-Z][A-Za-z]+"')
while read -r code; do
  if ! grep -qxF "\"$code\"" <<<"$named"; then
    echo "core/src/base/reasons.hpp: no error names $code"
    broken=1
  fi
done < <(grep -oE '^    \{"[A-Z][A-Za-z]+' core/src/base/reasons.hpp | tr -d ' {"')

# A public header that includes one of the source tree compiles here and nowhere else.
if grep -rn '^#include "' core/include | grep -v '"sillon/'; then broken=1; fi

find core -name '*.[ch]pp' -print0 | sort -z |
  xargs -0 grep -nE '^[[:space:]]*#[[:space:]]*include' /dev/null |
  awk -v rooms="$rooms" -v forbidden="^<($forbidden)>\$" '
    function breach(text) { print where ": " text; broken = 1 }
    BEGIN {
      n = split(rooms, lines, "\n")
      for (k = 1; k <= n; ++k) {
        if (split(lines[k], sides, ":") < 2) continue
        known[sides[1]] = 1
        may[sides[1], "base"] = 1
        may[sides[1], sides[1]] = 1
        m = split(sides[2], names, " ")
        for (i = 1; i <= m; ++i) {
          if (!(names[i] in known)) { print "tests/check_includes.sh: " names[i] " stands below " sides[1]; broken = 1 }
          may[sides[1], names[i]] = 1
        }
      }
    }
    {
      split($0, part, ":")
      where = part[1] ":" part[2]
      room = part[1]
      sub(/^core\/(include\/sillon|src)\//, "", room)
      header = $0
      sub(/^[^:]*:[^:]*:[^"<]*/, "", header)
      sub(/[^">]*$/, "", header)
      if (header ~ forbidden) breach("core includes no " header)
      if (header !~ /^"/ || room == "sillon.hpp") next
      gsub(/"/, "", header)
      sub(/^sillon\//, "", header)
      if (room !~ /\// || header !~ /\//) { breach("a file of core lies in a room, and is included by room/name.hpp"); next }
      sub(/\/.*/, "", room)
      sub(/\/.*/, "", header)
      if (!(room in known)) { breach(room " has no row in tests/check_includes.sh"); next }
      if (!((room, header) in may)) breach(room " may not include " header ", see tests/check_includes.sh")
      included[room, header] = 1
    }
    END {
      for (pair in may) {
        split(pair, side, SUBSEP)
        if (side[1] == side[2] || side[2] == "base" || pair in included) continue
        print "tests/check_includes.sh: " side[1] " names " side[2] ", and includes nothing of it"
        broken = 1
      }
      exit broken
    }' || broken=1
exit "$broken"
