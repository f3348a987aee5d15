#!/usr/bin/env bash
# readme_bites.sh: proves that readme.sh bites.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0
measured='Measured on a machine, a compiler, commit 0123abc, 2026-11-28, by `report`.'

complain() {
  echo "$1"
  cat "$work/out"
  failures=$((failures + 1))
}

# write LINES ROWS ROW TEXT: a page of so many lines more, its table of so many rows.
write() {
  {
    yes '' | head -n "$1"
    printf '%s\n' '<!-- report: begin -->' '| scene | rate |' '|---|---|'
    yes "$3" | head -n "$2"
    printf '%s\n' "$4" '<!-- report: end -->'
  } >"$work/README.md"
}

# expect RESULT LINES ROWS [ROW [TEXT]]
expect() {
  local result=fails
  write "$2" "$3" "${4:-| u1000 | 73.9 |}" "${5:-$measured}"
  "$here/readme.sh" "$work/README.md" >"$work/out" && result=passes
  [[ "$result" == "$1" ]] || complain "$result: $*"
}

set +o pipefail  # yes ends by a signal
expect passes 10 8
expect passes 97 8
expect passes 10 0
expect fails 10 9
expect fails 98 8
expect fails 10 1 '| u1000 | TABLE |'
expect fails 10 1 '' 'Measured on a machine, a compiler, 2026-11-28'
expect fails 10 1 '' 'Measured on a machine, a compiler, commit 0123abc'
echo 'no marks' >"$work/README.md"
if "$here/readme.sh" "$work/README.md" >"$work/out"; then complain "a page without a table passes"; fi

# in_clone CODE TEXT: figures with this text, in a clone whose report writes the table above.
in_clone() {
  local code=0
  write 10 1 '| u1000 | 73.9 |' "$2"
  "$here/readme.sh" "$work/README.md" "$work/clone" >"$work/out" || code=$?
  ((code == $1)) || complain "exit code $code: $2"
}

mkdir -p "$work/clone/bench/report"
in_clone 77 "$measured"
git="git -C $work/clone -c user.name=a -c user.email=a@b.invalid -c core.hooksPath=/dev/null"
echo 'HEADING = "| scene | rate |"' >"$work/clone/bench/report/readme.py"
$git init -q && $git add . && $git commit -qm "one: commit"
good="$($git rev-parse --short=12 HEAD)"
echo 'HEADING = "| scene | speed |"' >"$work/clone/bench/report/readme.py"
$git commit -qam "another: table"
other="$($git rev-parse --short=12 HEAD)"
in_clone 0 "${measured/0123abc/$good}"
in_clone 1 "$measured"
in_clone 1 "${measured/0123abc/$good+}"
in_clone 1 "${measured/0123abc/$other}"
in_clone 0 "${measured/commit 0123abc/committed as commit $other}"
in_clone 1 "${measured/commit 0123abc/committed as commit 0123abc}"
((failures == 0)) || exit 1
echo "every rule bites"
