#!/usr/bin/env bash
# commands.sh PROGRAM SOURCE BUILD [PAGE...]: what the documents, or these pages, show is so.
#
# Every block of TOML or NFF is a scene, every block of C++ compiles. Every line of a block of sh is tried:
# boule and the programs that make data run, in a copy of the scenes' folder, once where several pages show
# the same. Of what takes minutes it is checked that there is such a thing: a target, a preset, a test that a ctest line
# selects, a word of bootstrap.sh. A block whose first line is "# NAME.toml" is that file for the commands. docs/command_line.md has all
# options of the program's help, and no others. A page of docs/howto has at most 100 lines, and commands.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
source "$here/pages.sh"
program="$(realpath "$1")" source="$(realpath "$2")" build="$(realpath "$3")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
unset BOULE_ISA SOURCE_DATE_EPOCH
wrong=0 tried=0
declare -A done_before

complain() {
  echo "$1"
  wrong=1
}

# npy SHAPE BYTES: a .npy file of float32 zeros.
npy() {
  printf '\x93NUMPY\x01\x00\x76\x00%-117s\n' "{'descr': '<f4', 'fortran_order': False, 'shape': ($1), }"
  head -c "$2" /dev/zero
}

# Where commands run: the scenes, what the documents say is there, and data for who has no NumPy.
mkdir "$work/blocks" "$work/here"
selected=("${@:4}")
((${#selected[@]} > 0)) || mapfile -t selected < <(pages "$source")
(cd "$source" && printf '%s\n' "${selected[@]}" | xargs awk -v folder="$work/blocks" -f "$here/blocks.awk")
cp "$source"/scenes/*.{toml,npy,exr,lens,xyz,csv,data} "$work/here"
cd "$work/here"
ln -s . scenes
npy '2, 3' 24 >cloud.npy
npy '2, 6' 48 >bonds.npy
npy '3, 8' 96 | tee rays.npy >bounded.npy
for block in "$work"/blocks/*.{toml,nff}; do
  [[ -f "$block" ]] || continue
  name="$(sed -n '2s/^# \([a-z_0-9]*\.\(toml\|nff\)\)$/\1/p' "$block")"
  [[ -z "$name" ]] || tail -n +2 "$block" >"$name"
done

# expect WHERE CODE COMMAND...: it ends with that exit code.
expect() {
  local where="$1" wanted="$2" code=0
  shift 2
  "$@" >"$work/out" 2>"$work/err" </dev/null || code=$?
  ((code == wanted)) || complain "$where: exit code $code of $*: $(tail -n 3 "$work/err")"
}

# try_scene BLOCK
try_scene() {
  local where name="block.${1##*.}"
  where="$(head -n 1 "$1")"
  tail -n +2 "$1" >"$name"
  expect "$where" 0 "$program" info "$name"
}

# try_python BLOCK: where there are a NumPy and the package boule for what imports them. Debian's Python, if
# there is one: the package is built for it.
try_python() {
  local python=python3
  [[ ! -x /usr/bin/python3 ]] || python=/usr/bin/python3
  ! grep -qE 'import (numpy|boule)' "$1" || "$python" -c 'import numpy' 2>/dev/null || return 0
  ! grep -q 'import boule' "$1" || [[ -d "$build/boule" ]] || return 0
  expect "$(head -n 1 "$1")" 0 env PYTHONPATH="$build" "$python" -c "$(tail -n +2 "$1")"
}

# try_cpp BLOCK: what includes <boule/boule.h> compiles, where there is a compiler.
try_cpp() {
  local compiler="${CXX:-c++}"
  command -v "$compiler" >/dev/null && grep -q '<boule/boule.h>' "$1" || return 0
  tail -n +2 "$1" >block.cpp
  expect "$(head -n 1 "$1")" 0 "$compiler" -std=c++20 -fsyntax-only -I "$source" -I "$source/render/apps/library/include" block.cpp
}

# has WHERE WORD TEXT WHAT: the text has it as a word.
has() {
  grep -qwF -- "$2" <<<"$3" || complain "$1: there is no $4 $2"
}

# try_cmake WHERE ARGUMENT...
try_cmake() {
  local where="$1"
  shift
  case "$*" in
    *--target*) has "$where" "$(sed 's/.*--target \([^ ]*\).*/\1/' <<<"$*")" "$targets" target ;;
    --preset*) has "$where" "\"$2\"" "$(cat "$source/CMakePresets.json")" preset ;;
    '--build '* | '--install '*) ;;
    *) complain "$where: nobody tries cmake $*" ;;
  esac
}

# try_ctest WHERE ARGUMENT...: a test is selected; one that is not built here is in the sources.
try_ctest() {
  local where="$1" listed word
  shift
  listed="$(ctest --test-dir "$build" -N "${@:3}" 2>&1)" || true
  grep -qE '^Total Tests: [1-9]' <<<"$listed" && return
  word="$(sed -n 's/.*-R \([A-Za-z]*\)$/\1/p' <<<"$*")"
  [[ -n "$word" ]] && grep -rqE "TEST.*\b$word|^ +$word\)" "$source/tests" 2>/dev/null && return
  complain "$where: ctest $* selects no test"
}

# try_ranks WHERE CODE -n RANKS boule ARGUMENT...: by the launcher, where there is one.
try_ranks() {
  local where="$1" code="$2" ranks="$4"
  shift 5
  if command -v mpirun >/dev/null; then
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
      OMPI_MCA_btl_vader_single_copy_mechanism=none expect "$where" "$code" mpirun -n "$ranks" "$program" "$@"
  else
    expect "$where" "$code" "$program" "$@"
  fi
}

# try_line WHERE LINE
try_line() {
  local where="$1" line="$2" code=0 words target=''
  [[ "$line" =~ '# exit code '([0-9]+) ]] && code="${BASH_REMATCH[1]}"
  line="$(sed 's/ *# .*//; s/^\([A-Z_]*=[^ ]* \)*//; s/^valgrind \(-[^ ]* \)*//' <<<"$line")"
  # A slow machine is no fault, nor are pictures of these pages tried at their size.
  line="$(sed -E 's/--time-limit [0-9]+[a-z]+/--time-limit 1h/' <<<"$line")"
  [[ "$where" != @(README.md:*|docs/@(gallery.md:*|particles.md:*|recipes.md:*|howto/*)) ]] || line="$(sed 's/--size [0-9x]*/--size 64x48/; s/--spp [0-9]*/--spp 1/' <<<"$line")"
  mapfile -t words < <(xargs -r printf '%s\n' <<<"$line")  # as the shell does, quotes and all
  ((${#words[@]} > 0)) || return 0
  tried=$((tried + 1))
  [[ -z "${done_before[$code $line]:-}" ]] || return 0
  done_before[$code $line]=yes
  if ((${#words[@]} > 2)) && [[ "${words[-2]}" == '>' ]]; then
    target="${words[-1]}"
    words=("${words[@]::${#words[@]}-2}")
  fi
  case "${words[0]}" in
    boule | build/release/bin/boule) expect "$where" "$code" "$program" "${words[@]:1}" ;;
    build/release/bin/boule_*) expect "$where" "$code" "$(dirname "$program")/${words[0]##*/}" "${words[@]:1}" ;;
    build/bench/bin/* | bench_*) has "$where" "${words[0]##*/}" "$benchmarks" benchmark ;;
    ./bootstrap.sh) has "$where" "${words[1]}" "$(sed -n '/usage: /,/^TEXT/p' "$source/bootstrap.sh")" word ;;
    cmake) try_cmake "$where" "${words[@]:1}" ;;
    ctest) try_ctest "$where" "${words[@]:1}" ;;
    mpirun) try_ranks "$where" "$code" "${words[@]:1}" ;;
    cmp) expect "$where" "$code" "${words[@]}" ;;
    git | clang-format-14) ;;
    *) [[ -x "$source/${words[0]}" ]] || complain "$where: nobody tries ${words[0]}" ;;
  esac
  [[ -z "$target" ]] || cp "$work/out" "$target"
}

# try_commands BLOCK: a line that ends with \ goes on.
try_commands() {
  local where line page number
  where="$(head -n 1 "$1")"
  page="${where%:*}" number="${where##*:}"
  while read -r line; do
    try_line "$page:$number" "$line"
    number=$((number + 1))
  done < <(tail -n +2 "$1")
}

# try_options: those of the help are those of the page.
try_options() {
  local page="$source/docs/command_line.md" helped shown
  [[ -f "$page" ]] || return 0
  helped="$(for command in '' render view pack merge scene trace info isa; do
    "$program" $command --help | grep -oE -- '(^ *|,)--?[a-z-]+' | tr -d ' ,'
  done | LC_ALL=C sort -u)"
  shown="$(grep -oE -- '`--?[a-z-]+' "$page" | tr -d '`' | LC_ALL=C sort -u || true)"
  [[ "$helped" == "$shown" ]] ||
    complain "docs/command_line.md: its options are not those of the help:
$(diff <(echo "$helped") <(echo "$shown") | grep '^[<>]')"
}

targets="$(cmake --build "$build" --target help 2>&1)"
benchmarks="$(cat "$source"/bench/CMakeLists.txt "$source"/bench/*/CMakeLists.txt 2>/dev/null || true)"
for block in "$work"/blocks/*; do  # in the order of the pages: what one makes, the next may read
  case "$block" in
    *.toml | *.nff) try_scene "$block" ;;
    *.python) try_python "$block" ;;
    *.cpp) try_cpp "$block" ;;
    *.sh) try_commands "$block" ;;
  esac
done
try_options
for page in "$source"/docs/howto/*.md; do
  [[ -f "$page" ]] || continue
  (($(wc -l <"$page") <= 100)) || complain "$page: more than 100 lines"
  grep -q '^```sh$' "$page" || complain "$page: no commands"
done
((wrong == 0)) || exit 1
((tried > 0)) || { echo "no commands in the documents of $source"; exit 1; }
echo "$tried commands and $(find "$work/blocks" -name '*.toml' -o -name '*.nff' | wc -l) scenes work"
