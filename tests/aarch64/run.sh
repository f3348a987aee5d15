#!/usr/bin/env bash
# From a clean clone to passing tests on aarch64, under qemu: see usage().
set -euo pipefail
source="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
readonly source

usage() {
  cat <<'TEXT'
usage: tests/aarch64/run.sh [BUILD_FOLDER]
  Cross-compiles core, simd and their tests for aarch64 and runs them under qemu-aarch64.
  BUILD_FOLDER is build/aarch64 unless named. Needs, on Debian 12, no arm64 packages but:
    apt-get install cmake ninja-build g++-aarch64-linux-gnu qemu-user googletest libxsimd-dev
TEXT
}

# cross FOLDER ARGUMENT...: configures a CMake project for aarch64.
cross() {
  cmake -G Ninja -B "$@" -DCMAKE_BUILD_TYPE=Release -DBOULE_AARCH64_ROOT="$root" \
    -DCMAKE_TOOLCHAIN_FILE="$source/tests/aarch64/toolchain.cmake"
}

# Installs GoogleTest from the source in Debian's package, and xsimd's headers. /usr/include itself
# must not be searched: its headers are for this machine.
install_dependencies() {
  mkdir -p "$root/include"
  cp -r /usr/include/xsimd "$root/include/"
  [[ -d "$root/lib/cmake/GTest" ]] && return
  cross "$build/googletest" -S /usr/src/googletest -DCMAKE_INSTALL_PREFIX="$root" \
    -DCMAKE_INSTALL_LIBDIR=lib
  cmake --build "$build/googletest"
  cmake --install "$build/googletest" >/dev/null
}

case "${1:-}" in
  -h | --help | help) usage; exit 0 ;;
  -*) usage >&2; exit 2 ;;
esac
build="$(realpath -m "${1:-$source/build/aarch64}")"
root="$build/root"
install_dependencies
cross "$build/boule" -S "$source" -DBOULE_RENDER=OFF -DBOULE_TESTS=ON -DBOULE_WERROR=ON
cmake --build "$build/boule" --target boule_test_core boule_test_simd boule_test_equivalence
file="$build/boule/tests/core/boule_test_core"
[[ "$(od -An -tu2 -j18 -N2 "$file")" -eq 183 ]] || { echo "$file is not for aarch64"; exit 1; }
for test in core simd equivalence; do
  qemu-aarch64 "$build/boule/tests/$test/boule_test_$test" --gtest_brief=1
done
