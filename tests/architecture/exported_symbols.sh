#!/usr/bin/env bash
# exported_symbols.sh LIBRARY HEADER CLANG OPTION... -- OBJECT|ARCHIVE...: the shared library shows what the
# public header declares, with all that it includes, and nothing else. Clang lists the declarations, with
# their symbols. Exit code 77: there is no clang.
set -euo pipefail
export LC_ALL=C CCACHE_DISABLE=1  # a compiler cache answers for headers as they were
library=$1 header=$2 compile=()
shift 2
while [[ "$1" != -- ]]; do compile+=("$1"); shift; done
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A constructor, and a destructor, has two or three symbols, of which clang names one.
one_name() { sed -E 's/([CD])[0-4]E/\14E/' | sort -u; }

command -v "${compile[0]}" >/dev/null || { echo "no clang"; exit 77; }
"${compile[@]}" -w -fsyntax-only -Xclang -ast-dump=json -Xclang -ast-dump-filter=boule -x c++ "$header" |
  sed -nE 's/.*"mangledName": "(_ZN[^"]*)".*/\1/p' | one_name >"$work/declared"
# Strong symbols; inline functions are in every program that uses them.
nm --defined-only "$@" 2>/dev/null | sed -nE 's/^[0-9a-f]+ [TDBR] (_Z.*)$/\1/p' | one_name >"$work/defined"
nm -D --defined-only "$library" | sed -nE 's/^[0-9a-f]+ [TDBR] (.*)$/\1/p' | one_name >"$work/shown"

wrong=0
# complain FIRST SECOND WHAT: what is in the first list only.
complain() {
  local found
  found=$(comm -23 "$1" "$2" | c++filt)
  [[ -z "$found" ]] || { printf '%s\n' "$found" | sed "s/$/: $3/"; wrong=1; }
}
comm -12 "$work/declared" "$work/defined" >"$work/public"
complain "$work/shown" "$work/public" "shown, but no public header declares it"
complain "$work/public" "$work/shown" "public, but hidden"
[[ -s "$work/shown" ]] || { echo "nothing is shown"; exit 1; }
# What is inline may be shown too, of ours alone.
others=$(nm -D --defined-only "$library" | sed -nE 's/^[0-9a-f]+ [^A] //p' | { grep -vE '^_Z(N[A-Z0-9]*|TV|T[IS]N?)5boule' || true; } | c++filt)
[[ -z "$others" ]] || { printf '%s\n' "$others" | sed 's/$/: shown, and not of boule/'; wrong=1; }
((wrong == 0)) || exit 1
echo "$(wc -l <"$work/shown") functions are shown, $(comm -23 "$work/defined" "$work/shown" | wc -l) are hidden"
