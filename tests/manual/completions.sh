#!/usr/bin/env bash
# completions.sh PROGRAM FOLDER [SHELL...]: the completions in the folder offer, in bash, and in zsh and fish where
# they are installed: the commands and options that the program has, the names that it takes, the files
# that fit. What the program refuses with a list of names, the completion offers by these names.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
program="$(realpath "$1")" folder="$(realpath "$2")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"
touch a.toml b.npy c.xyz d.png e.film f.svg g.md
mkdir sub
wrong=0 tried=0

complain() {
  echo "$1"
  wrong=1
}

# sorted: each line of standard input with its words in order, slashes and lists' beginnings left out.
sorted() {
  sed 's|/||g; s/depth,//; s/--solver=//g' | awk '{ n = split($0, word)
    for (i = 2; i <= n; ++i)
      for (j = i; j > 1 && word[j - 1] > word[j]; --j) { x = word[j]; word[j] = word[j - 1]; word[j - 1] = x }
    line = ""
    for (i = 1; i <= n; ++i) line = line (i > 1 ? " " : "") word[i]
    print line }'
}

# compare SHELL: its answers to all `lines`, with those that are `wanted`.
compare() {
  local answers expected
  readarray -t answers < <(ask "$1" "${lines[@]}" | sorted)
  readarray -t expected < <(printf '%s\n' "${wanted[@]}" | sorted)
  for i in "${!lines[@]}"; do
    [[ "${answers[i]:-}" == "${expected[i]}" ]] ||
      complain "$1: '${lines[i]}': ${answers[i]:-}, expected ${expected[i]}"
    tried=$((tried + 1))
  done
}

# ask SHELL LINE...: what the completion of that shell answers to each, a line each.
ask() {
  local shell="$1" line
  shift
  case "$shell" in
    bash) bash "$here/ask.bash" "$folder/boule.bash" "$@" ;;
    zsh) timeout 60 zsh -f "$here/ask.zsh" "$folder" "$@" ;;
    fish)
      for line in "$@"; do
        HOME="$work" fish --no-config -c "source $folder/boule.fish; complete -C '$line'" | cut -f1 | tr '\n' ' '
        echo
      done
      ;;
  esac
}

# Lines, and the words that they get; a folder is sub or sub/.
commands="$("$program" --help | sed -n '/^Commands:/,$s/^  \([a-z]*\) .*/\1/p')"
readarray -t cases <<CASES
boule mer|merge
boule help tr|trace
boule help |${commands//$'\n'/ }
boule render |a.toml b.npy c.xyz sub
boule render --solv|--solver
boule render --solver |fast reference robust
boule render --solver=f|fast
boule render a.toml -o |d.png e.film sub
boule render a.toml --aov depth,nor|normal
boule render --legend |f.svg sub
boule merge e.film |e.film sub
boule trace a.toml --rays |b.npy sub
boule isa --|--help --json
boule view --port |
CASES
lines=("${cases[@]%%|*}")
wanted=("${cases[@]#*|}")
shells=("${@:3}")
((${#shells[@]} > 0)) || shells=(bash zsh fish)
for shell in "${shells[@]}"; do
  command -v "$shell" >/dev/null || { echo "$shell is not installed: not tried"; continue; }
  compare "$shell"
done

# Every option of every command, and what each takes, asked once.
lines=() wanted=()
asked=' '
for command in $commands; do
  helped="$("$program" "$command" --help | sed -nE 's/^ {1,7}(-[a-z]\b)?,? ?(--[a-z-]+)?.*/\1 \2/p')"
  lines+=("boule $command -")
  wanted+=("${helped//$'\n'/ }")
  for option in $helped; do
    [[ "$option" == --* && "$asked" != *" $option "* ]] || continue
    asked+="$option "
    refused="$("$program" "$command" x "$option" no/such 2>&1 >/dev/null || true)"
    [[ "$refused" =~ 'is not understood, expected '(one|some)' of '([^;]*) ]] || continue
    names="${BASH_REMATCH[2]%% or colours*}"
    names="${names%%, each once*}"
    names="${names%%$'\n'*}"
    names="${names//[^a-z0-9_-]/ }"
    lines+=("boule $command x $option ")
    wanted+=("${names/ or / }")
  done
done
compare bash
((wrong == 0)) || exit 1
((tried > 30)) || { echo "nothing was tried"; exit 1; }
echo "$tried completions are right"
