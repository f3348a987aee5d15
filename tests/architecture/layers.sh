#!/usr/bin/env bash
# layers.sh ROOT: the rules of layers.awk over every source file below ROOT.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cd "$1"

mapfile -t files < <(find core simd render tests bench -name '*.h' -o -name '*.cpp' | LC_ALL=C sort)
((${#files[@]} > 0)) || { echo "no source files in $1"; exit 1; }
awk -f "$here/layers.awk" "${files[@]}"
echo "${#files[@]} files keep to their layers"
