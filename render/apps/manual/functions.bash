# shellcheck shell=bash
# Behind the tables of bash_completion.cpp. `=` parts words: "--solver=f" is three.

# The files that end so, and folders; all files where none does.
_boule_files() {
  local ending found=()
  for ending in $1; do
    mapfile -t -O "${#found[@]}" found < <(compgen -f -X "!*$ending" -- "$2")
  done
  ((${#found[@]} > 0)) || mapfile -t found < <(compgen -f -- "$2")
  mapfile -t -O "${#found[@]}" found < <(compgen -d -- "$2")
  mapfile -t COMPREPLY < <(printf '%s\n' "${found[@]}" | LC_ALL=C sort -u | sed '/^$/d')
  compopt -o filenames 2>/dev/null
}

# What an option takes, or a positional: words, then endings of files behind a bar.
_boule_value() {
  local words="${1%%|*}" endings="${1#*|}" start=''
  if [[ "$words" == *, ]]; then  # a list with commas
    [[ "$2" != *,* ]] || start="${2%,*},"
    mapfile -t COMPREPLY < <(compgen -P "$start" -W "${words%,}" -- "${2##*,}")
    compopt -o nospace 2>/dev/null
  elif [[ -n "$words" ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$2")
  elif [[ -n "$endings" ]]; then
    _boule_files "$endings" "$2"
  fi
}

_boule() {
  local current="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD - 1]}" command="${COMP_WORDS[1]}"
  COMPREPLY=()
  if [[ "$current" == '=' ]]; then
    current=''
  elif [[ "$before" == '=' ]]; then
    before="${COMP_WORDS[COMP_CWORD - 2]}"
  fi
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$_boule_commands ${_boule_options[-]}" -- "$current")
  elif [[ -n "${_boule_takes["$command $before"]+there}" ]]; then
    _boule_value "${_boule_takes["$command $before"]}" "$current"
  elif [[ "$current" == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${_boule_options["$command"]}" -- "$current")
  elif [[ -n "${_boule_takes["$command"]+there}" ]]; then
    _boule_value "${_boule_takes["$command"]}" "$current"
  fi
}

complete -F _boule boule
