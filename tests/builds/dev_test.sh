#!/usr/bin/env bash
# ./dev waits while another program holds apt's locks, and gives up at once on any other problem. HarfBuzz's sources are those
# of one hash, or none.
#   tests/builds/dev_test.sh
set -euo pipefail
dev=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/dev
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "dev_test: $*" >&2
  exit 1
}

# Stands for apt-get: fails `failures` times with `problem`, then succeeds. sudo and sleep stay out of the test.
cat >"$folder/apt-get" <<'TEXT'
#!/usr/bin/env bash
echo "$*" >>"$FOLDER/calls"
[ "$(wc -l <"$FOLDER/calls")" -gt "$(cat "$FOLDER/failures")" ] && exit 0
cat "$FOLDER/problem" >&2
exit 100
TEXT
printf '#!/bin/sh\nexec "$@"\n' >"$folder/sudo"
printf '#!/bin/sh\n' >"$folder/sleep"
chmod +x "$folder/apt-get" "$folder/sudo" "$folder/sleep"

# run FAILURES PROBLEM: exit code of apt_get, its output in `said`.
run() {
  echo "$1" >"$folder/failures"
  echo "$2" >"$folder/problem"
  : >"$folder/calls"
  code=0
  FOLDER=$folder PATH="$folder:$PATH" bash -c 'source "$0" help >/dev/null; apt_get install sillon-needs' "$dev" >"$folder/said" 2>&1 || code=$?
}

run 3 'E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 7 (unattended-upgr)'
[ "$code" = 0 ] || fail "a lock that is given back ends with $code: $(cat "$folder/said")"
[ "$(wc -l <"$folder/calls")" = 4 ] || fail "apt-get was called $(wc -l <"$folder/calls") times instead of 4"
[ "$(cat "$folder/said")" = 'waiting for another installation to end, five minutes at most' ] ||
  fail "while waiting it says: $(cat "$folder/said")"

run 1000 'E: Could not get lock /var/lib/apt/lists/lock. It is held by process 7 (apt-get)'
[ "$code" = 1 ] || fail "a lock that is held for ever ends with $code"
grep -q 'held by process 7' "$folder/said" || fail "who holds the lock is not told: $(cat "$folder/said")"

run 1000 'E: Unable to locate package sillon-needs'
[ "$code" = 1 ] || fail "a missing package ends with $code"
[ "$(wc -l <"$folder/calls")" = 1 ] || fail "a missing package was looked for $(wc -l <"$folder/calls") times"

# Stands for pip3: keeps what it is asked for and fetches FETCHED, if that is there.
cat >"$folder/pip3" <<'TEXT'
#!/usr/bin/env bash
echo "$*" >"$FOLDER/asked"
while [ $# -gt 0 ]; do
  case $1 in
    --dest) dest=$2 ;;
    --requirement) cp "$2" "$FOLDER/wanted" ;;
  esac
  shift
done
cp "$FOLDER/fetched.tar.gz" "$dest"
TEXT
chmod +x "$folder/pip3"
fetch() {
  code=0
  FOLDER=$folder PATH="$folder:$PATH" bash -c 'source "$0" help >/dev/null; harfbuzz=$FOLDER/sources; fetch_harfbuzz' "$dev" >"$folder/said" 2>&1 || code=$?
}
fetch
[ "$code" = 1 ] || fail "sources that cannot be fetched end with $code: $(cat "$folder/said")"
grep -q 'pip could not fetch .* sources of HarfBuzz' "$folder/said" || fail "they are told as: $(cat "$folder/said")"
[ ! -e "$folder/sources" ] || fail "sources that could not be fetched are there"
grep -q -- --require-hashes "$folder/asked" || fail "pip is not asked to look at hashes: $(cat "$folder/asked")"
grep -qE '^[a-z]+==[0-9.]+ --hash=sha256:[0-9a-f]{64}$' "$folder/wanted" || fail "pip is asked for $(cat "$folder/wanted")"

package=$(sed 's/==/-/; s/ .*//' "$folder/wanted")
mkdir -p "$folder/$package/harfbuzz/src"
touch "$folder/$package/harfbuzz/COPYING" "$folder/$package/harfbuzz/src/harfbuzz.cc"
tar czf "$folder/fetched.tar.gz" -C "$folder" "$package"
fetch
[ "$code" = 0 ] || fail "sources that are fetched end with $code: $(cat "$folder/said")"
[ -e "$folder/sources/src/harfbuzz.cc" ] || fail "sources are not where the build looks"
[ ! -e "$folder/sources.part" ] || fail "the download is left beside them"
