#!/usr/bin/env bash
# instructions.sh ISA=OBJECT[,OBJECT]... -- OBJECT|ARCHIVE...: the objects of an instruction set have no
# instruction of a wider one. What stands after the --, the rest of the program, runs on every x86-64.
#
# The code is disassembled, and what that says is assembled again for a CPU that has these
# instructions and no others: the assembler's tables are the judge. Every path is seen, whether a test
# takes it or not. Instructions that estimate are refused everywhere: each maker's CPUs have other bits.
# All others have the same bits on every CPU, so one that has them speaks for all.
set -euo pipefail
export LC_ALL=C
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
wrong=0 total=0

# What a CPU must have for an instruction set to be selected: simd/dispatch/cpu.cpp.
declare -A has=(
  [scalar]=
  [sse42]=+sse4.2+popcnt
  [avx2]=+avx2+fma+bmi+bmi2+popcnt
  [avx512]=+avx2+fma+bmi+bmi2+popcnt+avx512f+avx512bw+avx512dq+avx512vl+avx512cd
)

# complain NAME LIST: reads "LINE, tab, words" about that line of LIST.s; each mnemonic once.
complain() {
  awk -F'\t' -v name="$1" '
    FILENAME == ARGV[1] { instruction[FNR] = $0; next }
    FILENAME == ARGV[2] { where[FNR] = $0; next }
    {
      mnemonic = instruction[$1 + 0]
      sub(/ .*/, "", mnemonic)
      if (!seen[mnemonic]++) print name ": " instruction[$1 + 0] " in " where[$1 + 0] ": " $2
    }' "$2.s" "$2.where" - | c++filt | head -n 10
  wrong=1
}

# check NAME EXTENSIONS FILE...
check() {
  local name="$1" extensions="$2" list="$work/$1" count
  shift 2
  for file in "$@"; do objdump -d --no-show-raw-insn "$file"; done |
    awk -v prefix="$list" -f "$here/instructions.awk"
  [[ -s "$list.s" ]] || { echo "$name: no instructions in $*"; exit 1; }
  if ! as -march="generic64$extensions" -o "$work/object" "$list.s" 2>"$work/err"; then
    complain "$name" "$list" < <(sed -nE 's/^[^:]*:([0-9]+): Error: /\1\t/p' "$work/err")
  fi
  if grep -nE '^v?r(cp|sqrt)[0-9]*[ps][sdh] ' "$list.s" >"$work/estimates"; then
    complain "$name" "$list" < <(sed -E 's/:.*/\tis an estimate/' "$work/estimates")
  fi
  count="$(wc -l <"$list.s")"
  total=$((total + count))
}

isas=()
while [[ "$1" != -- ]]; do
  isa="${1%%=*}"
  [[ -n "${has[$isa]+known}" ]] || { echo "$isa: nobody knows what it has"; exit 1; }
  isas+=("$isa")
  IFS=, read -ra objects <<<"${1#*=}"
  check "$isa" "${has[$isa]}" "${objects[@]}"
  shift
done
shift
((${#isas[@]} > 0)) || { echo "no kernel objects given"; exit 1; }
# xgetbv: where the CPU says that it has it.
check rest +xsave "$@"
((wrong == 0)) || exit 1
echo "${isas[*]} and the rest: $total different instructions, none that a CPU may lack"
