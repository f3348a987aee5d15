#!/usr/bin/env bash
# initialisers.sh CXX SOURCE: who names some members of the interface's structs and leaves out the others gets
# no warning, of this compiler and of those that are there.
set -euo pipefail
cxx="$1" boule="$2"
for compiler in "$cxx" g++ clang++-14; do
  command -v "$compiler" >/dev/null || continue
  "$compiler" -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I"$boule" -I"$boule/render/apps/library/include" \
    "$boule/tests/consumer/initialisers.cpp"
done
