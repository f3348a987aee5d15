#!/usr/bin/env bash
# test_names.sh ROOT: the limit of test_names.awk on the names of tests below ROOT/tests.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cd "$1"

# Folders, and a file, whose names are still to be shortened. Take a folder off this list when you have
# done that; add none.
long_names=(tests/bench tests/scenes tests/view tests/render/bad_input_test.cpp
  tests/render/{cli,file,packed,particle_file,particles,python,scene_file,trace_file,view})

mapfile -t files < <(find tests -name '*.h' -o -name '*.cpp' -o -name '*.py' | LC_ALL=C sort |
  grep -vE "^($(IFS='|'; echo "${long_names[*]}"))(/|$)")
((${#files[@]} > 0)) || { echo "no tests in $1"; exit 1; }
awk -f "$here/test_names.awk" "${files[@]}"
