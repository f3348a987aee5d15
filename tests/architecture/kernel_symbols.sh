#!/usr/bin/env bash
# kernel_symbols.sh ISA=OBJECT[,OBJECT]... -- OBJECT|ARCHIVE...: which symbols the kernel objects of each
# instruction set define and need. After the -- stands the rest of the program.
#
# The linker keeps one copy of a weak symbol. If that were the copy of the AVX-512 object, an inline
# function shared with the rest would stop the program on every other CPU.
set -euo pipefail
export LC_ALL=C

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
wrong=0

complain() {
  echo "$1"
  wrong=1
}

# weak_symbols FILE...: mangled names of their weak and unique definitions.
weak_symbols() {
  nm --defined-only --extern-only "$@" 2>/dev/null |
    awk 'NF > 1 && $(NF - 1) ~ /^[WVuwv]$/ { print $NF }' | sort -u
}

# shared_between NAME LIST NAME LIST: complains of what stands in both.
shared_between() {
  local shared
  shared="$(comm -12 "$2" "$4" | head -5 | c++filt)"
  [[ -z "$shared" ]] || complain "$1 and $3 share weak symbols:"$'\n'"$shared"
}

# Below: ISA OBJECT...

check_exports() {
  local isa="$1" exported
  exported="$(nm --defined-only --extern-only -C "${@:2}" |
    awk 'NF > 1 && $2 !~ /^[WVuwv]$/ { $1 = $2 = ""; print substr($0, 3) }')"
  [[ "$exported" == "boule::$isa::kernel_table" ]] ||
    complain "$isa must export boule::$isa::kernel_table and nothing else, exports: $exported"
}

# They may ask each other, for templates of their namespace.
check_imports() {
  local isa="$1" asked
  nm --defined-only --extern-only "${@:2}" | awk 'NF > 1 { print $NF }' | sort -u >"$work/defined"
  asked="$(nm --undefined-only "${@:2}" | awk '$1 == "U" { print $NF }' | sort -u |
    comm -23 - "$work/defined" |
    grep -vxE 'mem(cpy|set|move|cmp)|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail' || true)"
  [[ -z "$asked" ]] || complain "$isa calls out: $(c++filt <<<"$asked" | paste -sd ' ')"
}

# Global constructors run before the CPU is asked for its ISAs; statics would be shared by threads.
check_sections() {
  local isa="$1" found
  found="$(readelf -SW "${@:2}" | sed 's/^ *\[ *[0-9]*\] *//' |
    awk '$1 ~ /^\.(init_array|ctors|preinit_array|fini_array|dtors)/ ||
         ($1 ~ /^\.(data|bss|tdata|tbss)(\.|$)/ && $1 !~ /^\.data\.rel\.ro/ &&
          $5 !~ /^0+$/) { print $1 }')"
  [[ -z "$found" ]] || complain "$isa has constructors or variables: $(paste -sd ' ' <<<"$found")"
}

isas=()
while [[ "$1" != -- ]]; do
  isa="${1%%=*}"
  IFS=, read -ra objects <<<"${1#*=}"
  isas+=("$isa")
  check_exports "$isa" "${objects[@]}"
  check_imports "$isa" "${objects[@]}"
  check_sections "$isa" "${objects[@]}"
  weak_symbols "${objects[@]}" >"$work/$isa"
  shift
done
shift
((${#isas[@]} > 0)) || complain "no kernel objects given"
for file in "$@"; do weak_symbols "$file"; done | sort -u >"$work/rest"
[[ -s "$work/rest" ]] || complain "the rest of the program has no weak symbols: wrong files?"

for ((i = 0; i < ${#isas[@]}; ++i)); do
  shared_between "${isas[i]}" "$work/${isas[i]}" "the rest of the program" "$work/rest"
  for ((j = i + 1; j < ${#isas[@]}; ++j)); do
    shared_between "${isas[i]}" "$work/${isas[i]}" "${isas[j]}" "$work/${isas[j]}"
  done
done
((wrong == 0)) || exit 1
echo "${isas[*]}: one table each, nothing shared, nothing asked for"
