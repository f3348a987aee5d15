#!/usr/bin/env bash
# commits_bites.sh: proves that commits.sh bites.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

# expect CODE TEXT: a page with this text.
expect() {
  local code=0
  printf '%s\n' "$2" >"$work/page.md"
  "$here/commits.sh" "$work" >"$work/out" || code=$?
  ((code == $1)) && return
  echo "exit code $code: $2"
  cat "$work/out"
  failures=$((failures + 1))
}

expect 77 'commit 0123abc'
git="git -C $work -c user.name=a -c user.email=a@b.invalid -c core.hooksPath=/dev/null"
$git init -q && $git commit -qm "one: commit" --allow-empty
commit="$($git rev-parse HEAD)"
expect 0 'no commit, 1000000 rays, a decade, defaced words'
expect 0 "commit ${commit::7} and $commit"
expect 1 "commit ${commit::7} and 0123abc"
expect 1 'commit `0123abc`'
expect 0 '```text
0123abc
```'
((failures == 0)) || exit 1
echo "every rule bites"
