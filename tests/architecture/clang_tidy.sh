#!/usr/bin/env bash
# clang_tidy.sh ROOT COMPILE_COMMANDS CLANG_TIDY [FOLDER...]: the checks of .clang-tidy over every source that is
# compiled, or of those in the folders, and every header of ours that one includes. Most of the time goes into the system's
# headers, so the sources of a folder are read together, a dozen at a time. Where two sources of a
# dozen define the same name, each half is read by itself, and so on; programs are read one by one.
# Tests are read without the checks that they break on purpose: they use what was moved away, ask for
# sizes that no memory has, compare bits, lay out rows by integer division, and need not be fast.
# Kernels and lanes are read as scalar code and as AVX2, every other source once. 77: there is no
# clang-tidy.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/compilations.sh"
root="$1" commands="$2" clang_tidy="$3"
shift 3
folders="$*"
readonly together=12
left_out_of_tests=
for check in bugprone-integer-division bugprone-misplaced-widening-cast bugprone-string-constructor \
  bugprone-suspicious-memory-comparison bugprone-unhandled-exception-at-new \
  bugprone-use-after-move performance-inefficient-vector-operation; do
  left_out_of_tests+=",-$check"
done
[[ -n "$clang_tidy" ]] || { echo "no clang-tidy-14"; exit 77; }
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
: >"$work/empty.cpp"

# A line per compilation: its group, the file, and what of its options says how to read it.
sources() {
  compilations "$commands" "$root" |
    awk -F'\t' -v root="$root/" -v folders="${folders// /|}" '
    {
      file = $1
      command = $2
      group = substr(file, length(root) + 1)
      if (folders != "" && group !~ "^(" folders ")/") next
      sub(/\/[^\/]*$/, "", group)
      gsub(/\\\\\\"/, "\"", command)
      isa = ""
      if (match(command, /-DBOULE_KERNEL_ISA=[a-z0-9]*/)) {
        isa = substr(command, RSTART + 19, RLENGTH - 19)
        if (isa != "scalar" && isa != "avx2") next
        group = group " " isa
      }
      while ((getline line < file) > 0) {
        if (line ~ /^int main\(/) group = group " " file
      }
      close(file)
      standard = command
      sub(/.* -std=/, "", standard)  # the last one counts
      sub(/ .*/, "", standard)
      group = group " " standard
      if (seen[group, file]++) next
      # What the shell would unquote: without its blanks, for words are told apart by them.
      while (match(command, /\\"[^\\]*\\"/)) {
        quoted = substr(command, RSTART + 2, RLENGTH - 4)
        gsub(/ /, "_", quoted)
        command = substr(command, 1, RSTART - 1) quoted substr(command, RSTART + RLENGTH)
      }
      options = ""
      words = split(command, word, / +/)
      for (i = 1; i <= words; ++i) {
        if (word[i] == "-isystem") options = options "\t-isystem\t" word[++i]
        else if (word[i] ~ /^-([DI]|std=|m)./) options = options "\t" word[i]
      }
      print group "\t" file options
    }' | LC_ALL=C sort
}

# read_together FILE OPTIONS...: the sources in FILE, a line each.
read_together() {
  local list="$1" includes=() file lines checks=-bugprone-suspicious-include
  shift
  while read -r file; do includes+=(-include "$file"); done <"$list"
  [[ "${includes[1]}" != "$root"/*tests/* ]] || checks+="$left_out_of_tests"
  # That sources are included is this script's own doing.
  if "$clang_tidy" --quiet --config-file="$root/.clang-tidy" --warnings-as-errors='*' \
    --checks="$checks" "$work/empty.cpp" -- "$@" "${includes[@]}" \
    >"$list.out" 2>&1; then
    return 0
  fi
  lines="$(wc -l <"$list")"
  if ((lines > 1)) && grep -qF '[clang-diagnostic-error' "$list.out"; then
    head -n $((lines / 2)) "$list" >"$list.a"
    tail -n +$((lines / 2 + 1)) "$list" >"$list.b"
    local wrong=0
    read_together "$list.a" "$@" || wrong=1
    read_together "$list.b" "$@" || wrong=1
    return "$wrong"
  fi
  grep -vE '^[0-9]+ warnings? (generated|treated)' "$list.out"
  return 1
}

# read_chunk FILE: lines of sources(), of one group.
read_chunk() {
  local options=()
  mapfile -t options < <(cut -f3- "$1" | awk -F'\t' '
    { for (i = 1; i <= NF; ++i) {
        option = $i
        if (option == "-isystem") option = option "\n" $(++i)
        if (option != "" && !seen[option]++) print option
      } }')
  cut -f2 "$1" >"$1.files"
  read_together "$1.files" "${options[@]}"
}

sources >"$work/sources"
[[ -s "$work/sources" ]] || { echo "no sources of $root in $commands"; exit 1; }
awk -F'\t' -v work="$work" -v together="$together" '
  $1 != group || count == together { group = $1; count = 0; ++chunk }
  { ++count; print >sprintf("%s/chunk.%03d", work, chunk) }' "$work/sources"

export -f read_together read_chunk
export root clang_tidy work left_out_of_tests
if printf '%s\0' "$work"/chunk.??? | xargs -0 -n 1 -P "$(nproc)" bash -euo pipefail -c 'read_chunk "$1"' -; then
  echo "$(wc -l <"$work/sources") sources are as .clang-tidy wants them"
else
  exit 1
fi
