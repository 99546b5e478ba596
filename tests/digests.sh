#!/usr/bin/env bash
# Makes every example and prints, a line each, its name, the digest of its toolpath, and checksum and size of every kind of file; then
# those of a base solid, of packed files, of calibrations and of what is read from a photograph. All systems must print the same:
# CI compares them.
#   tests/digests.sh SILLON [ARGS]     an emulator may stand before the program: qemu-aarch64 -L ROOT build/arm/sillon
# ONLY=pattern: of the examples, only those with such names.
set -euo pipefail
case $1 in */*) program=$(realpath "$1") ;; *) program=$1 ;; esac
sillon=("$program" "${@:2}")
cd "$(dirname "${BASH_SOURCE[0]}")/../examples"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export SOURCE_DATE_EPOCH=0

# sum FILE...: checksum and size of each. A report's times, memory and threads are no part of the promise.
sum() {
  local file
  for file in "$@"; do
    case $file in
      *.json) sed -e 's/\r$//' -e '/^  "time": {/,/^  }/d' -e '/"peakBytes"\|"threads"\|"seconds"/d' "$folder/$file" | cksum ;;
      *) cksum <"$folder/$file" ;;
    esac
  done | tr '\n' ' '
}

for project in *.json; do
  # shellcheck disable=SC2053  # it is a pattern
  [[ $project == ${ONLY:-*} ]] || continue
  "${sillon[@]}" generate "$project" --quiet --gcode "$folder/g" --svg "$folder/s" --report "$folder/r.json" \
    --preview "$folder/p" --preview-width 300 --view "$folder/v"
  digest=$(tr -d ' "\r' <"$folder/r.json" | tr ',' '\n' | sed -n 's/.*digest:\([0-9a-f]*\).*/\1/p')
  [ ${#digest} = 16 ] || exit 1
  printf '%s %s %s\n' "$project" "$digest" "$(sum g s r.json p v)"
done

"${sillon[@]}" generate --shape disc --size 16 --base-pattern across --body "$folder/b.stl" --quiet
for packed in gz bgcode; do
  "${sillon[@]}" generate --shape disc --size 12 --gcode "$folder/x.gcode.$packed" --quiet
done
"${sillon[@]}" zones --shape disc --size 60 --directions inputs/noise.png --zones 6 -o "$folder/z.3mf" >/dev/null
"${sillon[@]}" calibrate coupon -o "$folder/coupon" >/dev/null
"${sillon[@]}" calibrate read ../docs/pictures/coupon-photograph.jpg --lamp-elevation 44 -o "$folder/spool" >"$folder/read.txt"
sed -i -e 's/\r$//' -e "s|$folder||g" "$folder/read.txt"
for file in b.stl x.gcode.gz x.gcode.bgcode z.3mf coupon spool read.txt; do printf '%s %s\n' "$file" "$(sum "$file")"; done
