#!/usr/bin/env bash
# find_package.sh CMAKE GENERATOR CXX flags=FLAGS PREFIX: an outside project builds against the installation,
# static and shared, its hits are exact, its picture is there; every installed header compiles outside.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/outside.sh"
prefix="$1"
lib="$(dirname "$(find "$prefix" -name libboule_files.a)")"

build find_package -DCMAKE_PREFIX_PATH="$prefix"
inherits example.cpp "-isystem $prefix/include -isystem $prefix/include/boule"
cd "$work"
hits='ray 0: primitive 0 at t = 5
ray 1: primitive 1 at t = 0.5
ray 2: primitive -1 at t = inf'
prints "$hits" "$here/module_used.sh" "$work/build/boule_image_io.so" build/example
[[ "$(head -c 3 example.jpg | od -An -tx1)" == ' ff d8 ff' ]] ||
  { echo "example.jpg is no picture"; exit 1; }

# The same with the shared library, which brings the module that is installed with it.
rm -r "$work/build" "$work/example.jpg"
build find_package -DCMAKE_PREFIX_PATH="$prefix" -DBOULE_LIBRARY=boule::shared
inherits example.cpp "-isystem $prefix/include/boule -isystem $prefix/include"
prints "$hits" "$here/module_used.sh" "$lib/boule/boule_image_io.so" build/example
[[ -s example.jpg ]] || { echo "no picture with the shared library"; exit 1; }

(cd "$prefix/include/boule" && find . -name '*.h' -printf '#include "%P"\n') >headers.cpp
"$cxx" -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I"$prefix/include/boule" headers.cpp
echo "$(wc -l <headers.cpp) headers"
