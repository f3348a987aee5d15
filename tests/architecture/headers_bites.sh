#!/usr/bin/env bash
# headers_bites.sh CXX: proves that headers.sh bites.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{core,simd/lanes,simd/kernel,render,tests,bench}
failures=0

# expect RESULT HEADER TEXT: the tree with just this header passes or fails.
expect() {
  local result=fails
  printf '%s\n' "$3" >"$work/$2"
  "$here/headers.sh" "$work" "${listed:-all}" "$cxx" -std=c++20 -Werror -- -DONE -- -DTWO >"$work/out" 2>&1 &&
    result=passes
  if [[ "$result" != "$1" ]]; then
    echo "$2 $result: $3"
    cat "$work/out"
    failures=$((failures + 1))
  fi
  rm "$work/$2"
}

cxx="$1"
expect passes core/a.h $'#pragma once\n#include <vector>\ninline std::vector<int> x;'
expect fails core/a.h $'#pragma once\ninline std::vector<int> x;'
expect fails core/a.h 'inline int twice = 0;'
expect passes simd/lanes/a.h $'#pragma once\n#if !defined(ONE) && !defined(TWO)\n#error\n#endif'
expect fails simd/lanes/a.h $'#pragma once\n#ifdef TWO\n#error\n#endif'
expect fails simd/lanes/a.h $'#pragma once\n#ifdef ONE\n#error\n#endif'
expect fails simd/kernel/a.h $'#pragma once\n#ifdef TWO\n#error\n#endif'
echo $'#include <vector>\n#include "core/a.h"' >"$work/core/a.cpp"
expect fails core/a.h $'#pragma once\ninline std::vector<int> x;'
echo $'#include "core/a.h"' >"$work/core/a.cpp"
expect fails core/a.h 'struct NoPragma {};'
rm "$work/core/a.cpp"
listed=core/a.h expect fails core/a.h $'#pragma once\ninline std::vector<int> x;'
listed=core/a.h expect passes core/a.h $'#pragma once'
echo $'#pragma once\ninline std::vector<int> x;' >"$work/core/b.h"
listed=core/a.h expect passes core/a.h $'#pragma once'
echo 'inline int twice = 0;' >"$work/core/b.h"
listed=core/a.h expect fails core/a.h $'#pragma once'
((failures == 0)) || exit 1
echo "every rule bites"
