#!/usr/bin/env bash
# hardening_bites.sh CXX: hardening.sh sees each protection that is missing.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cxx="$1"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

cat >sample.cpp <<'CODE'
#include <cstring>
#include <unistd.h>
int main(int argc, char** argv) {
  char text[64];
  std::strcpy(text, argv[0]);
  const long got = ::read(0, text, static_cast<unsigned long>(argc) * 16);
  return got > 0 && text[got - 1] == 'x' ? 1 : 0;
}
CODE

# build NAME FLAG...: a program that has it all, but for what the flags take away.
build() {
  local name="$1"
  shift
  "$cxx" -O2 -fPIE -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 -fstack-protector-strong sample.cpp \
    -pie -Wl,-z,relro,-z,now "$@" -o "$name"
}
# sees NAME WORDS: hardening.sh refuses the program for this reason alone.
sees() {
  local said
  if said="$("$here/hardening.sh" "$1" --)"; then
    echo "$1: not seen"
    exit 1
  fi
  [[ "$said" == "$1: $2" ]] || { echo "$1: said '$said', expected '$2'"; exit 1; }
}

build whole
"$here/hardening.sh" whole -- >/dev/null
build fixed -fno-pie -no-pie
sees fixed "lies where the linker put it"
build writable -Wl,-z,norelro
sees writable "tables of addresses can be written"
build lazy -Wl,-z,lazy
sees lazy "functions are looked for while it runs"
build stacks -fno-stack-protector
sees stacks "stacks are not checked"
build calls -U_FORTIFY_SOURCE
sees calls "calls are not checked"
"$cxx" -O2 -c -fPIC -fstack-protector-strong sample.cpp -o slow.o
if said="$("$here/hardening.sh" whole -- loops=slow.o)"; then echo "slow.o: not seen"; exit 1; fi
[[ "$said" == "loops: its loops pay for checks" ]] || { echo "said '$said'"; exit 1; }
if "$here/hardening.sh" >/dev/null; then echo "nothing is not seen"; exit 1; fi
echo "hardening.sh bites"
