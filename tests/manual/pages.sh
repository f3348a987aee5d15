#!/usr/bin/env bash
# pages.sh PROGRAM FOLDER SOURCE MANUAL LOWDOWN VERSION: the manual pages in the folder are whole. Every
# command has its page, with the options of its help and no others; boule-scene(5) has all that is set in
# `code` in docs/scene_format.md; docs/command_line.md names the options. They are the same bytes when MANUAL
# and LOWDOWN make them again in other surroundings, and man, lexgrog and mandoc, where they are installed,
# find no fault. Exit code 77: there are no pages, or nothing that shows them.
set -euo pipefail
program="$(realpath "$1")" folder="$(realpath "$2")" source="$(realpath "$3")" manual="$(realpath "$4")"
lowdown="$5" version="$6"
[[ -f "$folder/boule.1" ]] || { echo "there are no manual pages: lowdown is not installed"; exit 77; }
command -v man >/dev/null || command -v mandoc >/dev/null || { echo "neither man nor mandoc is installed"; exit 77; }
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
export LC_ALL=C MANROFFOPT=
wrong=0

complain() {
  echo "$1"
  wrong=1
}

# options TEXT: those that begin an entry, sorted.
options() {
  sed -nE 's/^ {1,7}(-[a-z]\b)?,? ?(--[a-z-]+)?.*/\1 \2/p' <<<"$1" | tr -s ' ' '\n' | sed '/^$/d' | sort -u
}

# plain PAGE: its text without fonts.
plain() {
  if command -v man >/dev/null; then
    man -l -Tascii "$1" 2>/dev/null | col -bx
  else
    mandoc -Tascii "$1" | col -bx
  fi
}

# help_of COMMAND: its options by its help.
help_of() {
  options "$("$program" "$1" --help)"
}
options_page="$(<"$source/docs/command_line.md")"

# The commands that a section of docs/command_line.md heads: the first of them names the page.
for command in $("$program" --help | sed -n '/^Commands:/,$s/^  \([a-z]*\) .*/\1/p'); do
  heading="$(grep -E "^## ([a-z]+, )*$command(, [a-z]+)*$" "$source/docs/command_line.md")"
  first="$(sed 's/^## //; s/,.*//' <<<"$heading")"
  [[ -f "$folder/boule-$first.1" ]] || { complain "boule $command has no page"; continue; }
  page="$(plain "$folder/boule-$first.1")"
  grep -qE "^ +boule $command( |$)" <<<"$page" || complain "boule-$first(1) does not show $command"
  shown="$(options "$(sed -n '/^OPTIONS/,/^E/p' <<<"$page")")"
  [[ "$shown" == "$(for word in $(sed 's/^## //; s/,//g' <<<"$heading"); do help_of "$word"; done | sort -u)" ]] ||
    complain "boule-$first(1): its options are not those of the help: $shown"
  for option in $shown; do
    [[ "$options_page" == *"\`$option"* ]] || complain "docs/command_line.md lacks $option"
  done
done

# Nothing of the document is lost on the way to its page: code, and lines of examples.
page="$(plain "$folder/boule-scene.5" | tr -s ' \n' ' ' | tr '[:upper:]' '[:lower:]')"
texts="$(cd "$source/docs" && awk '
  /^```/ { fenced = !fenced; next }
  fenced { print; next }
  {
    while (match($0, /`[^`]+`/)) {
      print substr($0, RSTART + 1, RLENGTH - 2)
      $0 = substr($0, RSTART + RLENGTH)
    }
  }' scene_format.md | sed 's/\\|/|/g' | tr -s ' ' | sed 's/^ //; /^$/d' | tr '[:upper:]' '[:lower:]' | sort -u)"
count=0
while read -r text; do
  [[ "$page" == *"$text"* ]] || complain "boule-scene(5) lacks: $text"
  count=$((count + 1))
done <<<"$texts"
((count > 300)) || complain "docs/scene_format.md has too little: $count"

# The same bytes again.
mkdir "$work/again"
date="$(sed -n 's/^\.TH .* "\([0-9-]*\)" "boule .*/\1/p' "$folder/boule.1")"
(
  export TZ=Asia/Tokyo LANG=C.UTF-8 LC_ALL=C.UTF-8
  cd / && "$manual" "$work/again" "$source"
  "$source/render/apps/manual/pages.sh" "$lowdown" "$work/again" "$version" "$date"
)
diff -r "$folder" "$work/again" >/dev/null || complain "the pages are others when they are made again"

# Found without fault by those who read them.
for page in "$folder"/*.[15]; do
  name="$(basename "$page" | sed 's/\.[15]$//')"
  if command -v man >/dev/null; then
    faults="$(man -l --warnings "$page" 2>&1 >/dev/null || true)"
    [[ -z "$faults" ]] || complain "man: $faults"
  fi
  ! command -v lexgrog >/dev/null || lexgrog "$page" | grep -qF "\"$name - " || complain "lexgrog: $page"
  ! command -v mandoc >/dev/null || mandoc -Tlint -Wwarning "$page" || complain "mandoc: $page"
done
((wrong == 0)) || exit 1
echo "$(find "$folder" -name '*.[15]' | wc -l) pages, $count texts of the scene format"
