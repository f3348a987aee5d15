#!/usr/bin/env bash
# links.sh ROOT [installed]: every relative link of every document leads to a file that is there, every
# anchor to a heading of it, and every path and every test of ours that is named in `code` exists: these
# not where the documents are installed, which sources are not. Addresses elsewhere are not looked at.
set -euo pipefail
what_to_check="${2:-all}"
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
source "$here/pages.sh"
cd "$1"

mapfile -t documents < <(pages .)
((${#documents[@]} > 0)) || { echo "no documents in $1"; exit 1; }
found="$(awk -f "$here/links.awk" "${documents[@]}")"
declare -A anchors=()
while read -r kind page slug; do
  [[ "$kind" != anchor ]] || anchors["$page#$slug"]=1
done <<<"$found"

# "SUITE NAME" of each, wherever its line was broken.
tests="$(find tests bench -name '*_test.cpp' -exec cat {} + 2>/dev/null | tr '\n' ' ' |
  grep -oE 'TEST(_F|_P)?\([A-Za-z0-9]+, *[A-Za-z0-9]+' | sed -E 's/.*\(([^,]*), */\1 /' || true)"

wrong=0 checked=0
complain() {
  echo "$1"
  wrong=1
}

# check_link WHERE TARGET
check_link() {
  local page="${1%:*}" path="${2%%#*}" anchor=""
  [[ "$2" != *'#'* ]] || anchor="${2#*#}"
  if [[ -z "$path" ]]; then
    path="$page"
  else
    path="$(realpath -ms --relative-to=. "$(dirname "$page")/$path")"
  fi
  if [[ ! -e "$path" ]]; then
    complain "$1: $2 leads nowhere"
  elif [[ -n "$anchor" && -z "${anchors["$path#$anchor"]:-}" ]]; then
    complain "$1: $path has no heading for #$anchor"
  fi
}

# check_path WHERE PATH: a pattern must match something.
check_path() {
  compgen -G "$2" >/dev/null || complain "$1: there is no $2"
}

# check_test WHERE SUITE.NAME
check_test() {
  local suite="${2%.*}" name="${2#*.}"
  [[ "$name" != '*' ]] || name='[A-Za-z0-9]+'
  grep -qE "^ *$suite $name\$" <<<"$tests" || complain "$1: there is no test $2"
}

while read -r kind where what; do
  [[ "$what" != *://* ]] || continue
  [[ "$kind" == link || "$what_to_check" != installed ]] || continue
  case "$kind" in
    link) check_link "$where" "$what" ;;
    path) check_path "$where" "$what" ;;
    test) check_test "$where" "$what" ;;
    *) continue ;;
  esac
  checked=$((checked + 1))
done <<<"$found"
((checked > 0)) || complain "no links in ${documents[*]}"
((wrong == 0)) || exit 1
echo "${#documents[@]} documents, $checked links and paths lead somewhere"
