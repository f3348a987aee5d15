#!/usr/bin/env bash
# formatting.sh ROOT [CLANG_FORMAT]: every source file is as .clang-format says.
# Exit code 77, "skipped", where there is no clang-format.
set -euo pipefail
[[ -n "${2:-}" ]] || { echo "clang-format was not found"; exit 77; }
cd "$1"
find core simd render tests bench \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 -r "$2" --style=file --dry-run -Werror
