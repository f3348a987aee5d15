#!/usr/bin/env bash
# flags_bites.sh: proves that flags.sh bites.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

compiler=Clang file=/src/a.cpp
# expect RESULT FLAGS...: a database of one entry per argument passes or fails.
expect() {
  local wanted="$1" result=fails flags
  shift
  {
    echo '['
    for flags in "$@"; do
      printf '{\n  "directory": "/b",\n  "command": "/usr/bin/c++ %s -o a.o -c %s",\n' "$flags" "$file"
      printf '  "file": "%s"\n},\n' "$file"
    done
    echo ']'
  } >"$work/commands.json"
  "$here/flags.sh" "$work/commands.json" /src $compiler >"$work/out" && result=passes
  [[ "$result" == "$wanted" ]] && return
  echo "$result: $*"
  failures=$((failures + 1))
}

expect passes '-O2 -ffp-contract=off -Wall'
expect passes '-ffp-contract=off' '-O3 -ffp-contract=off'
expect fails # nothing at all
expect fails '-O2'
expect fails '-ffp-contract=off' '-O2'
expect fails '-O2 -ffp-contract=off' '-O2 -ffp-contract=offf'
for flag in -ffast-math -Ofast -funsafe-math-optimizations -ffinite-math-only -ffp-contract=fast \
  -march=native; do
  expect fails "-ffp-contract=off $flag"
  expect fails "$flag -ffp-contract=off"
done
# Sources that are compiled together.
mkdir "$work/Unity"
file="$work/Unity/unity_0_cxx.cxx"
echo '#include "/src/a.cpp"' >"$file"
expect passes '-O2 -ffp-contract=off -Wall'
expect fails '-O2'
echo '#include "/elsewhere/a.cpp"' >"$file"
expect fails '-O2 -ffp-contract=off -Wall'
file=/src/a.cpp
compiler=GNU
expect fails '-O2 -ffp-contract=off -Wall'
expect passes '-O2 -ffp-contract=off -fno-tree-slp-vectorize -Wall'
((failures == 0)) || exit 1
echo "every rule bites"
