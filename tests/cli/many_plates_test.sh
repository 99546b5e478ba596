#!/usr/bin/env bash
# examples/many-plates on four projects, one of them at fault: stopped, resumed, mended. Needs GNU parallel and jq.
#   tests/cli/many_plates_test.sh SILLON
set -euo pipefail
SILLON=$1
export SILLON SOURCE_DATE_EPOCH=0 JOBS=2 PICTURE=64
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../examples/many-plates" && pwd)
for tool in parallel jq; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: $tool is not installed"
    exit 0
  fi
done

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  echo "many_plates_test: $*" >&2
  exit 1
}
expect() { # expect CODE COMMAND...
  local code=0
  "${@:2}" >said 2>&1 || code=$?
  [ "$code" = "$1" ] || fail "exit code $code instead of $1 of ${*:2}: $(cat said)"
}
jobs_done() { tail -n +2 plates/jobs.log | wc -l; }

mkdir projects
project() { printf '{ "sillon": 1, "shape": { "builtin": "disc", "size": [%s, 0] }, "toolpath": { "spacing": 1 } }' "$2" >"projects/$1.json"; }
project a 12
project "b c" 14 # a name with a space
project d -1

expect 2 "$here/run" nowhere plates
grep -q 'there is no folder nowhere' said || fail "the missing folder is not named: $(cat said)"
# One folder for both, by whatever name: nothing is made, so nothing may be counted.
ln -s projects same
expect 2 "$here/run" projects same
expect 2 "$here/table" projects projects/
grep -q 'holds the projects; the plates need a folder of their own' said || fail "one folder for both is told as: $(cat said)"
[ "$(ls projects)" = "$(printf 'a.json\nb c.json\nd.json')" ] || fail "one folder for both has left files: $(ls projects)"

# A project at fault: the others are made, its sentence is in the table.
expect 2 "$here/run" projects plates
grep -q '2 plates made, 1 missing' said || fail "said $(cat said)"
[ "$(wc -l <plates/report.csv)" = 4 ] || fail "the table has not a row per project"
grep '^"d","no".*size.*-1' plates/report.csv >/dev/null || fail "the table does not say what is wrong with d"
for file in plates/a.gcode "plates/b c.gcode" "plates/b c.png"; do
  [ -s "$file" ] || fail "$file is missing"
done
[ ! -e plates/d.gcode ] || fail "a plate at fault has left a file"
# Only a report tells of a plate.
cp projects/d.json plates/d.report.json
expect 2 "$here/table" projects plates
grep -q '2 plates made, 1 missing' said || fail "a project in a report's place counts as a plate: $(cat said)"
grep -q '^"d","no".*size.*-1' plates/report.csv || fail "a project in a report's place hides what is wrong"

# Run again, only what failed is tried.
project d 16
project e 18 # comes later
rm plates/a.gcode # proves that a is not made again
expect 0 "$here/run" projects plates
for file in plates/d.gcode plates/e.gcode; do
  [ -s "$file" ] || fail "$file is missing, which was mended or added"
done
[ ! -e plates/a.gcode ] || fail "a plate that was done was made again"
[ ! -e plates/d.err ] || fail "an old error is still there"
[ "$(jobs_done)" = 5 ] || fail "$(jobs_done) jobs in the log instead of 5"
[ "$(cut -d, -f1 plates/report.csv | tr -d '"\n')" = "plateab cde" ] || fail "the table's rows are not in order of names"

# Stopped in the middle of the list, as if the machine had gone down: the log says how far it came.
mkdir stopped
cp plates/projects.txt plates/a.report.json stopped
awk 'NR == 1 || $1 == 1' plates/jobs.log >stopped/jobs.log
expect 0 "$here/run" projects stopped
grep -q '4 plates made, 0 missing' said || fail "after a stop it said $(cat said)"
[ ! -e stopped/a.gcode ] || fail "what was done before the stop was made again"
[ "$(tail -n +2 stopped/jobs.log | wc -l)" = 4 ] || fail "not just the rest was made after a stop"

# The same bytes from one job at a time.
JOBS=1 expect 0 "$here/run" projects again
cmp again/d.gcode plates/d.gcode || fail "another number of jobs gave other bytes"
cmp again/report.csv plates/report.csv || fail "another number of jobs gave another table"
echo "many plates: made, resumed, the same bytes"
