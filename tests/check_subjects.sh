#!/usr/bin/env bash
# The subject of each commit that main does not have yet tells a part and what it now does. Prints each fault; silent and 0
# if there is none. Passes over a clone without main or its history, and says so.
set -euo pipefail
export LC_ALL=C.UTF-8 # ${#subject} counts letters
cd "$(dirname "${BASH_SOURCE[0]}")/.."

main=$(git rev-parse --verify --quiet origin/main || git rev-parse --verify --quiet main || true)
if [[ -z $main || $(git rev-parse --is-shallow-repository) == true ]]; then
  echo "  skipped: this clone does not have the history of main"
  exit 0
fi

broken=0
while read -r commit subject; do
  # The tip of a pull request on GitHub is a merge of its own.
  [[ $subject =~ ^Merge\ [0-9a-f]{40}\ into\ [0-9a-f]{40}$ ]] && continue
  fault=""
  if ((${#subject} > 72)); then fault="has ${#subject} letters; it may have 72"; fi
  if [[ ! $subject =~ ^[^:]+:\ [^\ ] ]]; then fault="must be \`part: What it now does\`"; fi
  if [[ $subject =~ ^([Ww][Ii][Pp]|index\ on|Merge)([^[:alnum:]]|$) ]]; then fault="does not tell what changes"; fi
  [[ -z $fault ]] && continue
  echo "$commit: the subject \"$subject\" $fault"
  broken=1
done < <(git log --format='%h %s' "$main..HEAD")
exit "$broken"
