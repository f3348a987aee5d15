#!/usr/bin/env bash
# test_names.sh ROOT: the limit of test_names.awk on the names of tests below ROOT/tests.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cd "$1"

mapfile -t files < <(find tests -name '*.h' -o -name '*.cpp' -o -name '*.py' | LC_ALL=C sort)
((${#files[@]} > 0)) || { echo "no tests in $1"; exit 1; }
awk -f "$here/test_names.awk" "${files[@]}"
