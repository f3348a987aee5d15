#!/usr/bin/env bash
# commit_hook.sh HOOK: the hook takes good subjects of commits and refuses bad ones.
set -euo pipefail
hook="$1"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

# expect RESULT MESSAGE
expect() {
  local result=refused
  printf '%s\n' "$2" >"$work/message"
  "$hook" "$work/message" 2>"$work/out" && result=taken
  [[ "$result" == "$1" ]] && return
  echo "$result: $2"
  failures=$((failures + 1))
}

letters() { head -c "$1" /dev/zero | tr '\0' x; }
expect taken "docs: $(letters 66)"
expect refused "docs: $(letters 67)"
expect taken "cli, python: say what is missing

$(letters 200)"
expect taken "# a comment of git
docs: a line"
expect refused "a line"
expect refused "docs:"
expect refused ""
expect taken "Merge branch 'a' into b"
expect taken "Revert \"docs: $(letters 80)\""
expect taken "fixup! docs: $(letters 80)"
((failures == 0)) || exit 1
echo "the hook bites"
