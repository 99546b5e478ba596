#!/bin/bash
# Memory and disk that fail at any call, for every command: all files or none, the old ones as they were, an exit code
# and one sentence.
# failing_test.sh PROGRAM [TIMES]: TIMES as many of the calls of `new` are tried (default 1).
set -euo pipefail
program=$1
times=${2:-1}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export SOURCE_DATE_EPOCH=0
cp "$root"/examples/inputs/{moon,sun}.png "$root"/tests/fuzz/seeds/rebrush/prusa.gcode \
  "$root"/tests/fuzz/seeds/import/bundle.ini "$root"/tests/fuzz/seeds/check/disc.gcode "$root"/docs/pictures/coupon-photograph.jpg .
printf '%s' '{"version": 1, "spools": {"mine": {"colour": [1, 2, 3], "fine": {"nozzleSide": [9, 16], "bedSide": [2, 9]}}}}' \
  >spools.json

printf '%s' '{"sillon": 1, "printer": {"flavor": "bambu", "startGcode": "G28\nM190 S60\nM109 S220\n"}}' >bambu.json

# Calls of `new` tried, evenly spread, and of the last ones, where files are written | files made in out/ | command, in
# which THREADS is 1 or 2. A file "=NAME" is changed in place. What makes no file tells on stdout.
commands='
90 60 | plate.gcode plate.json plate.svg | generate --shape disc --size 6 --threads THREADS --gcode out/plate.gcode --report out/plate.json --svg out/plate.svg
30 60 | a.gcode.3mf a.png a-2.png c.png c-2.png v.png b.3mf p.json | generate bambu.json --shape disc --size 5 --spacing 0.8 --layer-height 0.2 --threads THREADS --picture moon.png --picture sun.png --gcode out/a.gcode.3mf --preview out/a.png --preview-width 32 --conflict out/c.png --view out/v.png --body out/b.3mf --project out/p.json
30 0 | | generate --shape disc --size 6 --threads THREADS --quiet
20 20 | disc.webp | generate --shape disc --size 5 --spacing 0.8 --threads THREADS --preview out/disc.webp --preview-width 32
20 60 | flow.gcode flow.png | calibrate flow --printer prusa-mini -o out/flow.gcode --preview out/flow.png --preview-width 32
10 40 | layer.bgcode | calibrate width --printer prusa-mini --json -o out/layer.bgcode
3 8 | read.json | calibrate read coupon-photograph.jpg --name mine -o out/read.json
30 60 | part.gcode part.json part.png | rebrush prusa.gcode --angle 30 --threads THREADS -o out/part.gcode --report out/part.json --preview out/part.png --preview-width 32
30 60 | =prusa.gcode | rebrush out/prusa.gcode --angle 30 --threads THREADS --spools spools.json --spool mine
20 10 | | rebrush prusa.gcode --list --json
40 60 | zones.3mf | zones --shape disc --size 6 --directions moon.png -o out/zones.3mf
30 20 | | import bundle.ini
30 20 | | check disc.gcode --json
30 20 | | shape moon.png
10 10 | | spools --spools spools.json
10 10 | | printers prusa-mini
10 10 | | settings
'

fail() {
  printf 'failing_test: %s: %s (exit code %s)\n' "$command" "$*" "$code" >&2
  cat said >&2
  exit 1
}

# before: what is there when a command begins. With a number, old files where that is odd, and else none.
begin() {
  rm -rf out before
  mkdir before
  local name
  for name in $files; do
    if [[ $name == =* ]]; then
      cp "${name#=}" "before/${name#=}"
    elif [ $((${1:-0} % 2)) = 1 ]; then
      echo old >"before/$name"
    fi
  done
  cp -r before out
}

# run THREADS [FAIL]: the answer in $code, what it says in the files "told" and "said"
run() {
  code=0
  # shellcheck disable=SC2086 # words
  env ${2:+SILLON_FAIL=$2} "$program" ${command//THREADS/$1} >told 2>said || code=$?
}

# Everything as it was, or everything new.
judge() {
  local name
  case $code in
    0)
      for name in $files; do
        name=${name#=}
        [ -s "out/$name" ] || fail "$1: no $name"
        if cmp -s "out/$name" "before/$name"; then fail "$1: $name is the old one"; fi
        # Reports tell the time it took.
        if [[ $name != plate.json ]] && ! cmp -s "out/$name" "made/$name"; then fail "$1: another $name"; fi
      done
      [ "$(find out -type f | wc -l)" = "$(wc -w <<<"$files")" ] || fail "$1: made $(find out -type f | tr '\n' ' ')"
      if [ -z "$files" ] && ! cmp -s told answer; then fail "$1: another answer"; fi
      ;;
    2)
      diff -r before out >/dev/null || fail "$1: $(diff -r before out | head -3)"
      if [ -s told ]; then fail "$1: something on stdout"; fi
      if [ "$(grep -c '^sillon: ' said)" != 1 ] || [ "$(wc -l <said)" != 1 ]; then fail "$1: not one sentence"; fi
      ;;
    *) fail "$1" ;;
  esac
}

total=0
while IFS='|' read -r tries files command; do
  [ -n "$command" ] || continue
  read -r spread last <<<"$tries"
  command=${command# }
  begin
  run 1
  [ $code = 0 ] || fail "no call fails"
  read -r allocations writes < <(tail -n 1 said)
  [ "$allocations" -gt 1000 ] || fail "$allocations allocations were counted"
  count=$(wc -w <<<"$files")
  [ "$writes" = $((6 * count + (count > 0 ? 1 : 0))) ] || fail "$writes writes were counted"
  rm -rf made
  mv out made
  mv told answer

  for ((n = 1; n <= writes; ++n)); do
    begin "$n"
    run 1 "write:$n"
    [ $code = 2 ] || fail "write $n of $writes"
    judge "write $n of $writes"
  done

  spread=$((times * spread))
  refused=0
  for ((k = 0; k < spread + last; ++k)); do
    n=$((k < spread ? 1 + k * allocations / spread : allocations - (k - spread)))
    begin $((k / 2))
    run $((1 + k % 2)) "new:$n"
    judge "allocation $n of $allocations"
    if [ $code = 2 ]; then refused=$((refused + 1)); fi
  done
  [ $refused -gt $((spread / 2)) ] || fail "only $refused runs were refused: this test fails to fail"
  echo "$writes writes, $((spread + last)) of $allocations allocations, $refused refused: $command"
  total=$((total + writes + spread + last))
done <<<"$commands"
[ $total -gt 1000 ] || exit 1
