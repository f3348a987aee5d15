#!/usr/bin/env bash
# readme_bites.sh: proves that readme.sh bites.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

# expect RESULT LINES ROWS [ROW]: a page of so many lines more, its table of so many rows.
expect() {
  local result=fails
  {
    yes '' | head -n "$2"
    printf '%s\n' '<!-- report: begin -->' '| scene | rate |' '|---|---|'
    yes "${4:-| u1000 | 73.9 |}" | head -n "$3"
    echo '<!-- report: end -->'
  } >"$work/README.md"
  "$here/readme.sh" "$work/README.md" >"$work/out" && result=passes
  [[ "$result" == "$1" ]] && return
  echo "$result: $*"
  cat "$work/out"
  failures=$((failures + 1))
}

set +o pipefail  # yes ends by a signal
expect passes 10 8
expect passes 118 8
expect passes 10 0
expect fails 10 9
expect fails 119 8
expect fails 10 1 '| u1000 | TABLE |'
echo 'no marks' >"$work/README.md"
if "$here/readme.sh" "$work/README.md" >"$work/out"; then
  echo "a page without a table passes"
  failures=$((failures + 1))
fi
((failures == 0)) || exit 1
echo "every rule bites"
