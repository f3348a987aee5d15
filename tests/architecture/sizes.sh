#!/usr/bin/env bash
# sizes.sh ROOT: the limits of sizes.awk over every source file below ROOT.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cd "$1"

mapfile -t files < <(find core simd render scenes tests bench -name '*.h' -o -name '*.cpp' | LC_ALL=C sort)
((${#files[@]} > 0)) || { echo "no source files in $1"; exit 1; }
awk -f "$here/sizes.awk" "${files[@]}"
echo "${#files[@]} files are short, and so are their functions"
