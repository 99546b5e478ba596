#!/bin/bash
# Memory and disk that fail at any call: all files or none, the old ones as they were, an exit code and one sentence.
# failing_test.sh PROGRAM [ALLOCATIONS]: how many of the calls of `new` are tried besides the last 100 (default 150).
set -euo pipefail
program=$1
tries=${2:-150}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export SOURCE_DATE_EPOCH=0
files="plate.gcode plate.json plate.svg"

# run THREADS [FAIL]: the answer in $code, stderr in the file "said"
run() {
  code=0
  env ${2:+SILLON_FAIL=$2} "$program" generate --shape disc --size 6 --threads "$1" \
    --gcode out/plate.gcode --report out/plate.json --svg out/plate.svg >/dev/null 2>said || code=$?
}

fail() {
  printf 'failing_test: %s (exit code %s)\n' "$*" "$code" >&2
  cat said >&2
  exit 1
}

# Everything as it was, or everything new.
judge() {
  local new=0 name
  [ "$(find out -mindepth 1 | wc -l)" = 3 ] || fail "$1: not three files but $(find out -mindepth 1 | tr '\n' ' ')"
  for name in $files; do
    if [ "$(cat "out/$name")" != old ]; then new=$((new + 1)); fi
  done
  case $code in
    0) [ $new = 3 ] || fail "$1: $new of 3 files are new" ;;
    2)
      [ $new = 0 ] || fail "$1: $new of 3 files are new"
      [ "$(grep -c '^sillon: ' said)" = 1 ] || fail "$1: no sentence"
      ;;
    *) fail "$1" ;;
  esac
}

mkdir out
run 1
[ $code = 0 ] || fail "no call fails"
read -r allocations writes <said
if [ "$allocations" -lt 1000 ] || [ "$writes" -lt 9 ]; then fail "$allocations allocations and $writes writes were counted"; fi

begin() {
  for name in $files; do echo old >"out/$name"; done
}

for ((n = 1; n <= writes; ++n)); do
  begin
  run 1 "write:$n"
  [ $code = 2 ] || fail "write $n of $writes"
  judge "write $n of $writes"
done

refused=0
for ((k = 0; k < tries + 100; ++k)); do
  # Evenly spread, then each of the last, where files are written.
  n=$((k < tries ? 1 + k * allocations / tries : allocations - (k - tries)))
  begin
  run $((1 + k % 2)) "new:$n"
  judge "allocation $n of $allocations"
  if [ $code = 2 ]; then refused=$((refused + 1)); fi
done
[ $refused -gt $((tries / 2)) ] || fail "only $refused runs were refused: this test fails to fail"
echo "$writes writes, $((tries + 100)) of $allocations allocations, $refused refused"
