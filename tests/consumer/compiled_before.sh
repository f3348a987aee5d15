#!/usr/bin/env bash
# compiled_before.sh COMPILE_COMMANDS COMPILER ARGUMENT...: compiles. What another build has compiled by the same
# command, from a source of the same text, is not compiled again: its object is taken.
set -euo pipefail
commands="$1"
shift

# Without what says where the dependencies go, the command is that of the database.
said=("$@") kept=() source='' object='' dependencies=''
while (($# > 0)); do
  case "$1" in
    -MD) ;;
    -MT) shift ;;
    -MF) shift && dependencies="$1" ;;
    -Werror) ;;  # it changes no object
    -o) shift && object="$1" ;;
    -c) shift && source="$1" ;;
    *) kept+=("$1") ;;
  esac
  shift
done

# before COMMAND: lines "SOURCE, tab, OBJECT" of what was compiled by it.
before() {
  sed -nE 's/^ *"command": "(.*)",$/\1/p' "$commands" | awk -v command="$1" '
    { sub(/ -Werror/, "") }
    match($0, / -o [^ ]+ -c [^ ]+$/) && substr($0, 1, RSTART - 1) == command {
      split(substr($0, RSTART), word, " ")
      print word[4] "\t" word[2]
    }'
}

while IFS=$'\t' read -r other_source other_object; do
  other_object="$(dirname "$commands")/$other_object"
  if cmp -s "$source" "$other_source" && [[ "$other_object" -nt "$other_source" ]]; then
    cp "$other_object" "$object"
    echo "$object:" >"$dependencies"
    exit 0
  fi
done < <(before "${kept[*]}")
exec "${said[@]}"
