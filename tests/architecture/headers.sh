#!/usr/bin/env bash
# headers.sh ROOT CXX FLAG... [-- ISA-FLAG...]...: every header compiles alone, and twice in a row.
# Those of the lanes and kernels do so with each group of ISA flags.
set -euo pipefail
cd "$1"
shift

base=()
isas=()
for argument in "$@"; do
  if [[ "$argument" == -- ]]; then
    isas+=("")
  elif ((${#isas[@]} > 0)); then
    isas[-1]+=" $argument"
  else
    base+=("$argument")
  fi
done

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
headers=0

# add HEADER FLAGS: a line "SOURCE FLAGS" of the work to do.
add() {
  local source="$work/$headers.cpp"
  printf '#include "%s"\n#include "%s"\n' "$1" "$1" >"$source"
  echo "$source $2" >>"$work/list"
  headers=$((headers + 1))
}

while read -r header; do
  case "$header" in
    simd/lanes/* | simd/kernel/*) for flags in "${isas[@]}"; do add "$header" "$flags"; done ;;
    *) add "$header" "" ;;
  esac
done < <(find core simd render tests bench -name '*.h' | LC_ALL=C sort)
((headers > 0)) || { echo "no headers in $PWD"; exit 1; }

# Never the machine's cores: the tests beside this one want theirs.
xargs -P 2 -L 1 "${base[@]}" -I. -fsyntax-only <"$work/list" || exit 1
echo "$headers headers stand alone"
