#!/usr/bin/env bash
# qemu_bites.sh QEMU CXX: proves that the emulated CPUs refuse the instructions that they lack. If
# they did not, qemu.sh would show nothing.
set -euo pipefail
qemu="$1" cxx="$2"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# program NAME INSTRUCTION: a program that executes it.
program() {
  printf 'int main() { asm volatile("%s" ::: "xmm0"); }\n' "$2" >"$work/$1.cpp"
  "$cxx" "$work/$1.cpp" -o "$work/$1"
}

# dies CPU NAME: the program must be stopped by SIGILL.
dies() {
  local code=0
  # A shell in between: the outer one would report the signal.
  bash -c '"$@" || exit $?' _ "$qemu" -cpu "$1" "$work/$2" 2>"$work/err" || code=$?
  ((code == 128 + 4)) || { echo "$2 on $1 ended with $code, not by SIGILL"; exit 1; }
}

program sse2 'paddd %%xmm0, %%xmm0'
program avx 'vpaddd %%xmm0, %%xmm0, %%xmm0'
program avx512 'vpaddd %%zmm0, %%zmm0, %%zmm0'
"$qemu" -cpu Nehalem "$work/sse2"
"$qemu" -cpu Haswell "$work/avx" 2>"$work/err"
dies Nehalem avx
dies Nehalem avx512
dies Haswell avx512
echo "each CPU refuses what it lacks"
