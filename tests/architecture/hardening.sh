#!/usr/bin/env bash
# hardening.sh PROGRAM MODULE... -- NAME=OBJECT[,OBJECT]...: the program and its modules are position
# independent, their relocated data is read-only before they run, calls and stacks are checked
# (_FORTIFY_SOURCE, -fstack-protector-strong). The kernels' objects have none of these checks.
set -euo pipefail
export LC_ALL=C
binaries=0
wrong=0

# lacks FILE WHAT: one line of what is missing.
lacks() {
  echo "$1: $2"
  wrong=1
}

check_binary() {
  local file="$1" segments dynamic symbols
  segments="$(readelf -hlW "$file")"
  dynamic="$(readelf -dW "$file")"
  symbols="$(readelf --dyn-syms -W "$file")"
  grep -qE '^ *Type: +DYN' <<<"$segments" || lacks "$file" "lies where the linker put it"
  grep -q 'GNU_RELRO' <<<"$segments" || lacks "$file" "tables of addresses can be written"
  grep -qE 'BIND_NOW|Flags:.* NOW' <<<"$dynamic" || lacks "$file" "functions are looked for while it runs"
  grep -q '__stack_chk_fail' <<<"$symbols" || lacks "$file" "stacks are not checked"
  # The module has none that could be.
  ((binaries > 0)) || grep -qE '__[a-z]+_chk(@|$)' <<<"$symbols" || lacks "$file" "calls are not checked"
}

while (($# > 0)) && [[ "$1" != -- ]]; do
  check_binary "$1"
  binaries=$((binaries + 1))
  shift
done
((binaries > 0)) || { echo "nothing to look at"; exit 1; }
shift || true
for kernel in "$@"; do
  IFS=, read -ra objects <<<"${kernel#*=}"
  if readelf -sW "${objects[@]}" | grep -qE '__stack_chk_fail|__[a-z]+_chk'; then
    lacks "${kernel%%=*}" "its loops pay for checks"
  fi
done
((wrong == 0)) || exit 1
echo "$binaries binaries are hardened, $# kernels are not"
