# shellcheck shell=bash disable=SC2206
# bash ask.bash SCRIPT LINE...: what the completion of boule in the script answers when the key Tab is
# pressed behind each line: a line of words for each.
[[ ! -r /usr/share/bash-completion/bash_completion ]] || source /usr/share/bash-completion/bash_completion
source "$1"
shift
function="$(complete -p boule | sed 's/.*-F \([^ ]*\) .*/\1/')"
for line in "$@"; do
  COMP_WORDS=(${line//=/ = })  # as bash parts words
  [[ "$line" != *[\ =] ]] || COMP_WORDS+=('')
  COMP_LINE="$line" COMP_POINT=${#line} COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMPREPLY=()
  "$function" boule "${COMP_WORDS[-1]}" "${COMP_WORDS[-2]}"
  echo "${COMPREPLY[*]}"
done
