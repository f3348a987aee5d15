#!/usr/bin/env bash
# instructions_bites.sh: proves that instructions.sh bites, on objects with one fault each, in code that
# nothing calls.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

# object NAME INSTRUCTION...: NAME.o, whose function has them.
object() {
  local name="$1"
  shift
  { echo "uncalled_$name:"; printf '%s\n' "$@"; } | as -o "$work/$name.o" -
}

faultless() {
  object scalar 'addsd %xmm0, %xmm1' 'rep bsf %eax, %ecx'
  object sse42 'pshufb %xmm0, %xmm1' 'pcmpgtq %xmm0, %xmm1' 'popcnt %eax, %ecx'
  object avx2 'vpaddd %ymm0, %ymm1, %ymm2' 'vfmadd213ps %ymm0, %ymm1, %ymm2' 'shlx %eax, %ecx, %edx'
  object avx512 'vpaddd %zmm0, %zmm1, %zmm2{%k1}' 'vpconflictd %xmm0, %xmm1' 'vpaddd %ymm0, %ymm1, %ymm17'
  object rest 'cpuid' 'xgetbv' 'addps %xmm0, %xmm1' 'jmp .' 'nopw %cs:0x0(%rax,%rax,1)' 'call 0x20'
}

check() {
  "$here/instructions.sh" "scalar=$work/scalar.o" "sse42=$work/sse42.o" "avx2=$work/avx2.o" \
    "avx512=$work/avx512.o" -- "$work/rest.o" >"$work/out" 2>&1
}

# refused NAME INSTRUCTION [WORDS]: an object with this one is refused, and the place and the words told.
refused() {
  cp "$work/$1.o" "$work/faultless.o"
  object "$1" "$2"
  if check; then
    echo "NOT REFUSED: $2 in $1"
    failures=$((failures + 1))
  elif ! grep -qE "^$1: .* in uncalled_$1: .*(${3:-not supported|bad register})" "$work/out"; then
    echo "WRONG WORDS: $2 in $1"
    cat "$work/out"
    failures=$((failures + 1))
  fi
  mv "$work/faultless.o" "$work/$1.o"
}

faultless
check || { echo "the faultless objects are refused:"; cat "$work/out"; failures=1; }

refused rest 'pshufb %xmm0, %xmm1'
refused rest 'haddps %xmm0, %xmm1'
refused rest 'popcnt %eax, %ecx'
refused rest 'vaddps %xmm0, %xmm1, %xmm2'
refused scalar 'roundsd $1, %xmm0, %xmm1'
refused scalar 'lzcnt %eax, %ecx'
refused sse42 'vpaddd %xmm0, %xmm1, %xmm2'
refused sse42 'vpaddd %ymm0, %ymm1, %ymm2'
refused sse42 'pclmulqdq $0, %xmm0, %xmm1'
refused avx2 'vpaddd %zmm0, %zmm1, %zmm2'
refused avx2 'vpaddd %ymm0, %ymm1, %ymm17'
refused avx2 'kmovw %k1, %eax'
refused sse42 'shlx %eax, %ecx, %edx'
refused avx2 'lzcnt %eax, %ecx'
refused avx512 'vpdpbusd %zmm0, %zmm1, %zmm2'
refused avx512 'vpopcntd %zmm0, %zmm1'
refused avx512 'vrcp14ps %zmm0, %zmm1' 'is an estimate'
refused sse42 'rsqrtss %xmm0, %xmm1' 'is an estimate'
as -o "$work/rest.o" - </dev/null
check && { echo "NOT REFUSED: an object without code"; failures=$((failures + 1)); }

((failures == 0)) || { echo "$failures faults slipped through"; exit 1; }
echo "every rule bites"
