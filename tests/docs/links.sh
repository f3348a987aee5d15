#!/usr/bin/env bash
# links.sh ROOT: every relative link of every document leads to a file that is there, every anchor to
# a heading of it, and every path of ours that is named in `code` exists. Addresses elsewhere are not
# looked at.
set -euo pipefail
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
    path="$(realpath -m --relative-to=. "$(dirname "$page")/$path")"
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

while read -r kind where what; do
  [[ "$what" != *://* ]] || continue
  case "$kind" in
    link) check_link "$where" "$what" ;;
    path) check_path "$where" "$what" ;;
    *) continue ;;
  esac
  checked=$((checked + 1))
done <<<"$found"
((checked > 0)) || complain "no links in ${documents[*]}"
((wrong == 0)) || exit 1
echo "${#documents[@]} documents, $checked links and paths lead somewhere"
