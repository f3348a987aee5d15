#!/usr/bin/env bash
# address.sh SOURCE BUILD: every test of every day under the address and undefined-behaviour
# sanitizers. Left out by CMake: what preloads a library or replaces operator new, as the sanitizers
# do (cli_faults, render_allocation, startup_bites), what limits addresses (cli_scale), and emulators,
# into whose addresses the sanitizers' shadow does not fit (qemu_*).
set -euo pipefail
source="$1" build="$2"

cmake --preset asan -S "$source" -B "$build" >/dev/null
cmake --build "$build" -j 2
exec ctest --test-dir "$build" -LE long -j 2 --output-on-failure
