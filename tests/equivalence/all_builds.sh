#!/usr/bin/env bash
# all_builds.sh SOURCE BUILD: builds by g++ and clang++, Debug and Release, find the same hash of
# hash_test.cpp and pass all tests of core, simd and equivalence.
set -euo pipefail
source="$1" build="$2"
for compiler in g++ clang++; do
  command -v "$compiler" >/dev/null || { echo "$compiler is missing"; exit 77; }
done
for compiler in g++ clang++; do
  for type in Debug Release; do
    folder="$build/$compiler-$type"
    cmake -G Ninja -S "$source" -B "$folder" -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_BUILD_TYPE="$type" -DBOULE_RENDER=OFF -DBOULE_TESTS=ON -DBOULE_WERROR=ON >/dev/null
    cmake --build "$folder" --target boule_test_core boule_test_simd boule_test_equivalence >/dev/null
    for test in core simd equivalence; do
      "$folder/tests/$test/boule_test_$test" --gtest_brief=1
    done
    "$folder/tests/equivalence/boule_test_equivalence" --gtest_filter='*Hash*' |
      grep -c '^\[       OK' | sed "s/^/$compiler $type: hashes found by tests: /"
  done
done
