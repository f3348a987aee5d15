#!/usr/bin/env bash
# exact_math.sh CMAKE GENERATOR CXX SOURCE: options that make hits wrong are refused when a project that has boule
# inside configures, wherever it gives them, and by the sources themselves.
set -euo pipefail
cmake="$1" generator="$2" cxx="$3" boule="$4"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# configure LINES OPTION...: a project with these lines before boule.
configure() {
  printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(outside CXX)' "$1" \
    "add_subdirectory($boule boule)" >"$work/CMakeLists.txt"
  rm -rf "$work/build"
  "$cmake" -S "$work" -B "$work/build" -G "$generator" -DCMAKE_CXX_COMPILER="$cxx" -DBOULE_RENDER=OFF \
    -DBOULE_ONLY_ISAS=scalar "${@:2}" >"$work/out" 2>&1
}

# refused OPTION LINES ARGUMENT...
refused() {
  if configure "${@:2}"; then
    echo "configured with $1: ${*:2}"
    exit 1
  fi
  tr '\n' ' ' <"$work/out" | grep -q -- "boule: $1 *makes *its *hits *wrong" || { cat "$work/out"; exit 1; }
}

refused -ffast-math 'add_compile_options(-ffast-math)'
refused -funsafe-math-optimizations 'add_compile_options(-O2 $<$<CONFIG:Release>:-funsafe-math-optimizations>)'
refused -ffast-math '' -DCMAKE_CXX_FLAGS="-march=native -ffast-math"
refused -Ofast '' -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-Ofast
refused -ffinite-math-only 'set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} -ffinite-math-only")'
CXXFLAGS=-fassociative-math refused -fassociative-math ''
configure 'add_compile_options(-fno-fast-math -fno-math-errno)' || { cat "$work/out"; exit 1; }

for source in core/base/version.cpp simd/dispatch/dispatch.cpp; do
  for option in -ffast-math -Ofast -ffinite-math-only; do
    if "$cxx" -std=c++20 -I"$boule" -DBOULE_VERSION='"1"' "$option" -fsyntax-only "$boule/$source" 2>"$work/out"; then
      echo "$source compiled with $option"
      exit 1
    fi
    grep -q 'make its hits wrong' "$work/out" || { cat "$work/out"; exit 1; }
  done
done
