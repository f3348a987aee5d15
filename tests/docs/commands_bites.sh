#!/usr/bin/env bash
# commands_bites.sh PROGRAM SOURCE BUILD: proves that commands.sh bites, on documents with one fault
# each.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
program="$1" source="$2" build="$3"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0
mkdir -p "$work"/{docs,scenes,bench}
cp "$source"/{bootstrap.sh,CMakePresets.json} "$work"
cp "$source"/scenes/{first_light.toml,sphereflake.npy,barrel.exr,double_gauss_50mm.lens,crambin.xyz,disc.csv,bilayer.data} "$work/scenes"
echo 'boule_bench(bench_one' >"$work/bench/CMakeLists.txt"

# expect RESULT TEXT [WORDS]: the page with this text passes, or fails with these words.
expect() {
  local result=fails
  printf '%s\n' "$2" >"$work/docs/page.md"
  "$here/commands.sh" "$program" "$work" "$build" >"$work/out" 2>&1 && result=passes
  if [[ "$result" != "$1" ]] || ! grep -qF -- "${3:-}" "$work/out"; then
    echo "$result: $2"
    cat "$work/out"
    failures=$((failures + 1))
  fi
}

# block LANGUAGE LINE...: such a block.
block() {
  printf '```%s\n' "$1"
  shift
  printf '%s\n' "$@" '```'
}

good="$(block sh 'boule info first_light.toml  # told' 'boule info none.toml  # exit code 3')"
expect passes "$good"
expect passes "$good
$(block toml '# one.toml' 'schema = 1')
$(block sh 'boule info one.toml' './bootstrap.sh render' 'cmake --preset release' 'bench_one --fast' \
  'cmake --build build/release --target boule_program' 'ctest --test-dir build/test -R docs' \
  'X=1 valgrind --tool=callgrind boule isa')"
expect passes "$good
$(block text 'boule nothing')"
expect fails "" 'no commands'
expect fails "$(block sh 'boule info none.toml')" 'docs/page.md:2: exit code 3 of'
expect fails "$(block sh 'boule isa  # exit code 2')" 'exit code 0 of'
expect fails "$(block sh 'boule render first_light.toml -o a.gif')" 'exit code 2 of'
expect fails "$good
$(block toml 'schema = 1' 'spheres = 3')" 'docs/page.md:6: exit code 3 of'
expect fails "$good
$(block nff 'x 1')" 'exit code 3 of'
expect fails "$(block sh './bootstrap.sh wash')" 'there is no word wash'
expect fails "$(block sh 'cmake --preset best')" 'there is no preset "best"'
expect fails "$(block sh 'cmake --build build/release --target boule_nothing')" 'no target boule_nothing'
expect fails "$(block sh 'ctest --test-dir build/test -R no.such.test')" 'selects no test'
expect fails "$(block sh 'bench_two')" 'there is no benchmark bench_two'
expect fails "$(block sh 'make')" 'nobody tries make'
ln -s "$(realpath "$source")"/{core,simd,render} "$work"
expect passes "$good
$(block cpp '#include <boule/boule.h>' 'boule::Scene scene;')"
expect fails "$good
$(block cpp '#include <boule/boule.h>' 'boule::NoSuchThing thing;')" 'exit code 1 of'
rm "$work"/{core,simd,render}
# Pages that say how to do something.
mkdir "$work/docs/howto"
{ block sh 'boule isa'; yes ''; } 2>/dev/null | head -n 101 >"$work/docs/howto/long.md" || true
expect fails "$good" 'more than 100 lines'
echo 'Do it.' >"$work/docs/howto/long.md"
expect fails "$good" 'no commands'
rm -r "$work/docs/howto"
# The options of the help, and those of its page.
echo 'No options.' >"$work/docs/command_line.md"
expect fails "$good" '< --exposure'
"$program" render --help | grep -oE -- '--?[a-z-]+' | sed 's/.*/`&`/' >"$work/docs/command_line.md"
for word in --rays --any-hit --json --version --no-such; do echo "\`$word\`"; done >>"$work/docs/command_line.md"
expect fails "$good" '> --no-such'
((failures == 0)) || exit 1
echo "every rule bites"
