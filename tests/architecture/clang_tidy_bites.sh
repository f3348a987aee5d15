#!/usr/bin/env bash
# clang_tidy_bites.sh ROOT CLANG_TIDY: proves that clang_tidy.sh bites: in a source, in a header, in a
# source beside another that it clashes with, in what is compiled for AVX2 alone.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
[[ -n "${2:-}" ]] || { echo "no clang-tidy-14"; exit 77; }
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

# fresh_tree: two sources and a header in core, kernels for two ISAs; nothing to complain about.
fresh_tree() {
  mkdir -p "$work"/{core,simd/kernel}
  cp "$1/.clang-tidy" "$work"
  printf '%s\n' '#pragma once' 'inline int twice(int x) { return 2 * x; }' >"$work/core/a.h"
  printf '%s\n' '#include "core/a.h"' 'namespace { int clash(int x) { return twice(x); } }' \
    'int a(int x) { return clash(x); }' >"$work/core/a.cpp"
  printf '%s\n' 'namespace { int clash(int x) { return x; } }' \
    'int b(int x) { return clash(x); }' >"$work/core/b.cpp"
  printf '%s\n' 'int k(int x) { return x; }' >"$work/simd/kernel/kernels.cpp"
  {
    echo '['
    entry core/a.cpp ''
    entry core/b.cpp ''
    entry simd/kernel/kernels.cpp '-DBOULE_KERNEL_ISA=scalar'
    entry simd/kernel/kernels.cpp '-DBOULE_KERNEL_ISA=avx2 -mavx2'
    echo ']'
  } >"$work/compile_commands.json"
}
entry() {
  printf '{\n  "directory": "%s",\n  "command": "c++ -I%s %s -std=gnu++20 -o x.o -c %s",\n  "file": "%s"\n},\n' \
    "$work" "$work" "$2" "$work/$1" "$work/$1"
}

# expect WORDS_OR_passes: of the tree as it is.
expect() {
  if "$here/clang_tidy.sh" "$work" "$work/compile_commands.json" "$clang_tidy" >"$work/out" 2>&1; then
    [[ "$1" == passes ]] && return
    echo "NOT REFUSED: $1"
  else
    [[ "$1" != passes ]] && grep -qF "$1" "$work/out" && return
    echo "EXPECTED: $1"
    cat "$work/out"
  fi
  failures=$((failures + 1))
}

# refused PATH TEXT WORDS: with this line more in that file.
refused() {
  fresh_tree "$root"
  echo "$2" >>"$work/$1"
  expect "$3"
}

root="$1" clang_tidy="$2"
fresh_tree "$root"
expect passes
refused core/a.cpp 'int BadName(int x) { return x; }' 'BadName'
refused core/b.cpp 'int* none() { return 0; }' 'modernize-use-nullptr'
refused core/a.h "inline void long_one(int& x) {$(printf '\n  ++x;%.0s' {1..50})
}" 'readability-function-size'
refused simd/kernel/kernels.cpp $'#ifdef __AVX2__\nint* none() { return 0; }\n#endif' 'modernize-use-nullptr'
refused core/b.cpp 'int c(int x) { return y; }' 'clang-diagnostic-error'
fresh_tree "$root"
echo '[]' >"$work/compile_commands.json"
expect 'no sources'

((failures == 0)) || { echo "$failures faults slipped through"; exit 1; }
echo "the check bites"
