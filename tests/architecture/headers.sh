#!/usr/bin/env bash
# headers.sh ROOT HEADERS CXX FLAG... [-- ISA-FLAG...]...: headers compile alone, and twice in a row: all of
# them, or those of the list "HEADER,HEADER". Every header begins with #pragma once, listed or not.
# Headers of the lanes are compiled with each group of ISA flags. Headers of the kernels, which see
# an ISA only through the lanes, are compiled with the first and the last group. A header that its own
# .cpp includes first is left out: the build compiles it alone anyway.
set -euo pipefail
cd "$1"
listed=",$2,"
shift 2

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

# Headers of the Python package are compiled where Python's own are known.
has_python=
[[ "${base[*]}" != *-isystem*python* ]] || has_python=yes

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
compilations=0

# add HEADER FLAGS: a line "SOURCE FLAGS" of the work to do.
add() {
  local source="$work/$compilations.cpp"
  printf '#include "%s"\n#include "%s"\n' "$1" "$1" >"$source"
  echo "$source $2" >>"$work/list"
  compilations=$((compilations + 1))
}

# compiled_first HEADER: its own .cpp includes it before anything else.
compiled_first() {
  local source="${1%.h}.cpp"
  [[ -f "$source" && "$(grep -m 1 '^ *#' "$source")" == "#include \"$1\"" ]]
}

while read -r header; do
  if [[ "$(grep -m 1 '^ *#' "$header")" != '#pragma once' ]]; then
    echo "$header: does not begin with #pragma once"
    exit 1
  fi
  [[ "$listed" == ,all, || "$listed" == *",$header,"* ]] || continue
  case "$header" in
    simd/lanes/*)
      for flags in "${isas[@]}"; do
        # One lane is no register: xsimd has no say there.
        [[ "$header" == simd/lanes/xsimd_* && "$flags" == *KERNEL_SCALAR* ]] && continue
        add "$header" "$flags"
      done
      ;;
    simd/kernel/*)
      add "$header" "${isas[0]}"
      add "$header" "${isas[-1]}"
      ;;
    render/apps/python/*) [[ -z "$has_python" ]] || compiled_first "$header" || add "$header" "" ;;
    *) compiled_first "$header" || add "$header" "" ;;
  esac
done < <(find core simd render tests bench -name '*.h' | LC_ALL=C sort)
((compilations > 0)) || { echo "no headers in $PWD"; exit 1; }

# Two at a time, not as many as the machine has cores: other tests run beside this one.
xargs -P 2 -L 1 "${base[@]}" -I. -fsyntax-only <"$work/list" || exit 1
echo "$compilations compilations: every header stands alone"
