#!/usr/bin/env bash
# A folder of thousands of small projects by examples/many-plates: plates per minute and core.
#   tests/bench/farm.sh SILLON [COUNT]      2000 discs of 20 to 40 mm, spacing 0.4 mm, each with an angle of its own
set -euo pipefail
SILLON=$1
export SILLON
count=${2:-2000}
examples=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../examples" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

mkdir "$folder/projects"
for ((k = 0; k < count; k++)); do
  printf '{ "sillon": 1, "shape": { "builtin": "disc", "size": [%d.%02d, 0] }, "layers": [{ "kind": "direction", "angle": %d }] }' \
    $((20 + k % 20)) $((k / 20 % 100)) $((k % 180)) >"$folder/projects/$k.json"
done

cores=$(getconf _NPROCESSORS_ONLN)
# timed COMMAND...: seconds, real and of processors, its children's included; what it says goes to $folder/said.
timed() {
  local TIMEFORMAT='%R %U %S'
  { time "$@" >"$folder/said" 2>&1; } 2>&1 || { cat "$folder/said" >&2 && exit 1; }
}
first=$(timed "$examples/many-plates/run" "$folder/projects" "$folder/plates")
cat "$folder/said"
again=$(timed "$examples/many-plates/run" "$folder/projects" "$folder/plates")
awk -v count="$count" -v cores="$cores" '
  NR == 1 { printf "%.0f s on %d cores, %.0f s of processor time: %.0f plates per minute of one core\n", $1, cores, $2 + $3, 60 * count / ($2 + $3) }
  NR == 2 { printf "again, with nothing to do: %.1f s of processor time\n", $2 + $3 }' <<<"$first"$'\n'"$again"
