#!/usr/bin/env bash
# No instruction multiplies and adds in one step: such results differ in their last bit from those of other machines.
#   tests/builds/fused_test.sh OBJECT...
set -euo pipefail
if ! command -v objdump >/dev/null; then
  echo "skipped: objdump is not installed"
  exit 0
fi
for object in "$@"; do
  objdump -d --no-show-raw-insn "$object" | grep -q 'mulpd\|mulsd' || { echo "$object does not multiply"; exit 1; }
  if objdump -d --no-show-raw-insn "$object" | grep -E 'vfn?m(add|sub)'; then exit 1; fi
done
