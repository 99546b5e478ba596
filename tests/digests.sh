#!/usr/bin/env bash
# Makes every example and prints, a line each, its name, the digest of its toolpath, and checksum and size of its G-code. All
# systems must print the same: CI compares them.
#   tests/digests.sh SILLON
set -euo pipefail
sillon=$1
cd "$(dirname "${BASH_SOURCE[0]}")/../examples"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export SOURCE_DATE_EPOCH=0
for project in *.json; do
  "$sillon" generate "$project" --quiet --gcode "$folder/g" --report "$folder/r"
  digest=$(tr -d ' "\r' <"$folder/r" | tr ',' '\n' | sed -n 's/.*digest:\([0-9a-f]*\).*/\1/p')
  [ ${#digest} = 16 ] || exit 1
  printf '%s %s %s\n' "$project" "$digest" "$(cksum <"$folder/g")"
done
