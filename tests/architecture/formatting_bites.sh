#!/usr/bin/env bash
# formatting_bites.sh ROOT CLANG_FORMAT: proves that formatting.sh bites.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
[[ -n "${2:-}" ]] || { echo "clang-format was not found"; exit 77; }

mkdir "$work"/{core,simd,render,tests,bench}
cp "$1/.clang-format" "$work"
echo 'int x = 0;' >"$work/core/a.cpp"
"$here/formatting.sh" "$work" "$2" || { echo "a clean file is refused"; exit 1; }
for fault in 'int  x = 0;' 'int *x;' "int x = $(printf ' + 1%.0s' {1..40});"; do
  echo "$fault" >"$work/core/a.cpp"
  if "$here/formatting.sh" "$work" "$2" 2>/dev/null; then
    echo "NOT REFUSED: $fault"
    exit 1
  fi
done
echo "the check bites"
