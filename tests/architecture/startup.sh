#!/usr/bin/env bash
# startup.sh PROGRAM MILLISECONDS: help, isa and a refused scene take at most that much processor
# time, which load does not change, in the best of several runs, and load nothing of OpenImageIO.
set -euo pipefail
program="$1" limit_us=$(($2 * 1000))
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
export LC_ALL=C

echo 'schema = 1 2' >"$work/refused.toml"

# run EXPECTED_CODE ARGUMENT...: the program, quietly, with this exit code.
run() {
  local expected="$1" code=0
  shift
  "$program" "$@" >"$work/out" 2>"$work/err" || code=$?
  ((code == expected)) ||
    { echo "boule $*: exit code $code, expected $expected"; cat "$work/err"; exit 1; }
}

# used_us EXPECTED_CODE ARGUMENT...: what a run takes of the processor, in microseconds.
used_us() {
  local TIMEFORMAT='%3U %3S' user system
  read -r user system < <({ time run "$@" >&2; } 2>&1)
  echo $((10#${user//./} * 1000 + 10#${system//./} * 1000))
}

# check EXPECTED_CODE ARGUMENT...: libraries and time of one command.
check() {
  local best="$((1 << 62))" taken i
  LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" run "$@"
  grep -qh 'libstdc++' "$work"/loaded.* || { echo "cannot see what is loaded"; exit 1; }
  if grep -qhiE 'OpenImageIO|boule_image_io' "$work"/loaded.*; then
    echo "boule ${*:2} loads OpenImageIO"
    exit 1
  fi
  rm -f "$work"/loaded.*

  for ((i = 0; i < 5; ++i)); do
    taken="$(used_us "$@")"
    ((taken < best)) && best="$taken"
  done
  echo "boule ${*:2}: $((best / 1000)).$((best % 1000 / 100)) ms"
  ((best < limit_us)) || { echo "longer than $((limit_us / 1000)) ms"; exit 1; }
}

check 0 --help
check 0 --version
check 0 isa
check 3 render "$work/refused.toml" -o "$work/picture.png"
check 3 render "$work/missing.toml" -o "$work/picture.png"
