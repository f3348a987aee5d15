#!/usr/bin/env bash
# address.sh SOURCE BUILD: all daily tests under the address and undefined-behaviour sanitizers. CMake
# leaves out the tests that preload a library or replace operator new, as the sanitizers do
# (cli_faults, render_allocation, startup_bites), that limit addresses (cli_scale), and emulators, into
# whose addresses the sanitizers' shadow does not fit (qemu_*).
set -euo pipefail
source="$1" build="$2"

cmake --preset asan -S "$source" -B "$build" >/dev/null
cmake --build "$build" -j 2
exec ctest --test-dir "$build" -LE long -j 2 --output-on-failure
