#!/usr/bin/env bash
# compiled_before.sh COMPILE_COMMANDS COMPILER ARGUMENT...: compiles, but for what another build has compiled
# from the same text by the same command: its object is taken.
set -euo pipefail
commands="$1"
shift

# words COMMAND: without what says where the dependencies go. The last four are -o OBJECT -c SOURCE.
words=() skip=0
for word in "$@"; do
  case "$word" in
    -MD) ;;
    -MT | -MF) skip=1 ;;
    *) ((skip)) && skip=0 || words+=("$word") ;;
  esac
done
