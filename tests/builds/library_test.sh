#!/usr/bin/env bash
# The library opens no files and no connections, and starts no programs: what it asks the system for tells.
#   tests/builds/library_test.sh ARCHIVE
set -euo pipefail
if ! command -v nm >/dev/null; then
  echo "skipped: nm is not installed"
  exit 0
fi
asked=$(nm --undefined-only "$1" 2>/dev/null | sed -n 's/^ *U _*//p' | sort -u)
grep -qx 'mem[a-z]*' <<<"$asked" || { echo "nm tells nothing of $1"; exit 1; }
files='f?dopen|open(64|at|at64)?|creat(64)?|opendir|mkstemp|tmpfile|mmap(64)?|dlopen'
streams='Z.*(basic_filebuf|basic_[io]?fstream|10filesystem).*'
others='socket|connect|bind|listen|accept4?|getaddrinfo|gethostbyname|system|popen|fork|execv?[lpe]*|posix_spawnp?'
if grep -xE "$files|f(re)?open(64)?|$streams|$others" <<<"$asked"; then exit 1; fi
