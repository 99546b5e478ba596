#!/usr/bin/env bash
# examples/many-plates/cluster.py with a stand-in for Ray that makes the plates one after the other in this process: which files
# travel, which are refused, and that no project ends the run.
#   tests/cli/many_plates_cluster_test.sh SILLON
set -euo pipefail
export SILLON=$1 SOURCE_DATE_EPOCH=0 PICTURE=64
example=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../examples/many-plates" && pwd)
python=${PYTHON:-python3}
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 9))' 2>/dev/null || { echo "skipped: $python is not Python 3.9 or newer" && exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  echo "many_plates_cluster_test: $*" >&2
  exit 1
}

# The calls of Ray's that cluster.py makes. Folders of nodes lie in TMPDIR.
mkdir stub nodes
cat >stub/ray.py <<'TEXT'
class exceptions:
    class RayError(Exception):
        pass

class Handle:
    pass

def remote(**options):
    def wrap(function):
        def call(*arguments):
            handle = Handle()
            try:
                handle.made = function(*arguments)
            except Exception as error:
                handle.error = exceptions.RayError(repr(error))
            return handle
        function.remote = call
        return function
    return wrap

def init(**options):
    pass

def wait(handles, num_returns):
    return handles[:1], handles[1:]

def get(handle):
    if hasattr(handle, "error"):
        raise handle.error
    return handle.made
TEXT
export PYTHONPATH=$folder/stub TMPDIR=$folder/nodes

# expect CODE PROJECTS PLATES
expect() {
  local code=0
  "$python" "$example/cluster.py" "$2" "$3" >said 2>&1 || code=$?
  [ "$code" = "$1" ] || fail "exit code $code instead of $1: $(cat said)"
}

mkdir -p projects/shapes elsewhere
drawing='<svg xmlns="http://www.w3.org/2000/svg" width="12mm" height="9mm"><path d="M0 0h45v34h-45z"/></svg>'
echo "$drawing" | tee projects/shapes/plate.svg projects/top.svg >elsewhere/plate.svg
cp "$example/../../core/data/fonts/bebas-neue.ttf" projects/shapes
file() { echo "{ \"sillon\": 1, \"shape\": { \"file\": \"$2\" }, \"toolpath\": { \"spacing\": 1 } }" >"projects/$1.json"; }
file below shapes/plate.svg
file roundabout shapes/../top.svg
file absolute "$folder/projects/top.svg"
file upwards ../elsewhere/plate.svg
file "and back" ../projects/top.svg
file gone shapes/gone.svg
# Every imported printer has such a block: a text that is longer than a file's name may be.
printf '{ "sillon": 1, "shape": { "file": "top.svg" }, "toolpath": { "spacing": 1 }, "printer": { "startGcode": "G28\\n%s" } }' \
  "$(printf 'G4 P1 ; waits a little\\n%.0s' {1..40})" >projects/block.json
echo '{ "sillon": 1, "shape": { "builtin": "rectangle", "size": [20, 12] }, "toolpath": { "spacing": 1 }, "layers": [{ "kind": "text", "text": "A", "textSize": 9, "font": "shapes/bebas-neue.ttf" }] }' >projects/letters.json
printf '%200000s' '' | tr ' ' '[' >projects/nested.json
printf '\377\376 no text' >projects/bytes.json
mkdir projects/folder.json

expect 2 projects plates
for name in below roundabout block letters; do
  (cd projects && "$SILLON" generate "$name.json" --quiet --gcode ../alone.gcode)
  cmp alone.gcode "plates/$name.gcode" || fail "$name is not what the program alone makes of it: $(cat said)"
  for suffix in png report.json; do [ -s "plates/$name.$suffix" ] || fail "$name.$suffix is missing"; done
done
grep -q '4 plates made, 7 failed' said || fail "said $(cat said)"
# told NAME SENTENCE: on stderr, and beside the plates.
told() {
  grep -qF "$1: " said || fail "$1 is not told: $(cat said)"
  grep -qF "$2" "plates/$1.err" || fail "$1 is told as $(cat "plates/$1.err")"
}
told absolute "it names \"$folder/projects/top.svg\", which travels to no node"
told upwards 'it names "../elsewhere/plate.svg", which travels to no node'
told "and back" 'it names "../projects/top.svg", which travels to no node'
told gone '"shapes/gone.svg" cannot be read'
told nested 'scene "nested.json"'
told bytes 'scene "bytes.json"'
told folder 'it is no file'
[ -z "$(ls nodes)" ] || fail "the nodes keep $(ls nodes)"
[ "$(find . -name top.svg)" = ./projects/top.svg ] || fail "a file was left at $(find . -name top.svg)"

# Run again, only what failed is tried.
rm plates/below.gcode
file gone top.svg
expect 2 projects plates
grep -q '5 plates made, 6 failed' said || fail "the second run said $(cat said)"
[ ! -e plates/gone.err ] || fail "an old error is still there"
[ ! -e plates/below.gcode ] || fail "a plate that was done was made again"

# One folder for both, and a folder without projects.
ln -s projects same
expect 1 projects same
grep -q 'holds the projects; the plates need a folder of their own' said || fail "one folder for both is told as: $(cat said)"
expect 1 elsewhere plates
grep -q 'there is no project' said || fail "no project is told as: $(cat said)"
echo "many plates on a cluster: the files of each travel, none ends the run"
