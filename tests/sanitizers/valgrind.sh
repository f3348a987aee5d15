#!/usr/bin/env bash
# valgrind.sh PROGRAM SCENE: renders small pictures under valgrind's memcheck, without AVX-512, which
# it does not know. Memory that OpenImageIO's libraries never free is not reported. 77: there is no
# valgrind.
set -euo pipefail
program="$1" scene="$2"

command -v valgrind >/dev/null || { echo "valgrind is not installed"; exit 77; }
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
for method in whitted path; do
  for isa in scalar sse42 avx2; do
    valgrind -q --error-exitcode=9 --max-stackframe=4194304 "$program" render "$scene" \
      -o "$work/$isa.exr" --size 32x18 --spp 2 -t 2 -q --isa "$isa" --method "$method"
    cmp "$work/$isa.exr" "$work/scalar.exr"
  done
done
