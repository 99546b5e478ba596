#!/usr/bin/env bash
# Builds the program for another processor and compares what it writes, in qemu, with what this machine's writes:
#   tests/other_machines.sh [aarch64|armhf|s390x] ...    Debian packages: qemu-user g++-aarch64-linux-gnu, g++-arm-linux-gnueabihf,
#                                                      g++-s390x-linux-gnu
# ONLY=pattern: of the examples, only those with such names. Some minutes for each example, and an hour for the build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ $# -gt 0 ] || set -- aarch64 s390x
export ONLY=${ONLY:-islands*}
here=$(tests/digests.sh build/release/sillon)
for machine in "$@"; do
  case $machine in
    aarch64) triple=aarch64-linux-gnu qemu=qemu-aarch64 ;;
    armhf) triple=arm-linux-gnueabihf qemu=qemu-arm ;;
    s390x) triple=s390x-linux-gnu qemu=qemu-s390x ;;
    *)
      echo "other_machines.sh: \"$machine\" is not known; it must be aarch64, armhf or s390x" >&2
      exit 2
      ;;
  esac
  for tool in "$triple-g++" "$qemu"; do
    command -v "$tool" >/dev/null || { echo "other_machines.sh: $tool is missing; the head of this file names its package" >&2; exit 2; }
  done
  cmake -S . -B "build/$machine" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_SYSTEM_NAME=Linux \
    -DCMAKE_SYSTEM_PROCESSOR="${machine/armhf/arm}" -DCMAKE_CXX_COMPILER="$triple-g++" \
    -DSILLON_TESTS=OFF -DSILLON_EXAMPLES=OFF -DSILLON_BENCH=OFF >/dev/null
  cmake --build "build/$machine" --target sillon
  diff <(echo "$here") <(tests/digests.sh "$qemu" -L "/usr/$triple" "$PWD/build/$machine/sillon")
  echo "$machine: the same bytes"
done
