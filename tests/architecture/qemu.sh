#!/usr/bin/env bash
# qemu.sh QEMU CPU ISA EQUIVALENCE_TEST [PROGRAM SCENE]: on that CPU the ISA is selected, its tests
# pass (a stray instruction of a wider one is a SIGILL), and the program renders.
set -euo pipefail
emulated=("$1" -cpu "$2") isa="$3" equivalence="$4" program="${5:-}" scene="${6:-}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
unset BOULE_ISA

# Most of the time would go into the hard cases as bundles, the sweep, a million samples of every
# camera, and large scenes, where the scalar path looks at every sphere. The others run the same
# kernels, HashOfAllHits in every form. And an emulator tells nothing about time.
slow="*HardBundles*:*RejectSweep*:*RaysAlongAnAxis*:*GivesTheScalarPathsAnswers*:*FindsShadows*"
slow="$slow:*SortsShadowRays*:*CameraTwin*:*SidesOfBoxesFar*:*SpecksAroundALight*"
slow="$slow:*RaysMeetWhatTheSceneWrittenOut*:*BundlesMeetWhatTheSceneWrittenOut*:*IdsAndSlotsBeyond31Bits*"
"${emulated[@]}" "$equivalence" --gtest_filter="*$isa*-$slow" >"$work/out" 2>"$work/err" ||
  { tail -n 30 "$work/out" "$work/err"; exit 1; }
tail -n 1 "$work/out"
grep -qE '^\[  PASSED  \] [1-9]' "$work/out" || { echo "no test of $isa ran"; exit 1; }
if grep -q 'SKIPPED' "$work/out"; then
  echo "tests of $isa were skipped"
  exit 1
fi

[[ -n "$program" ]] || exit 0
# The list has one object per ISA, a member per line.
"${emulated[@]}" "$program" isa --json 2>"$work/err" |
  awk '/"name"/ { name = $2 } /"selected": true/ { print name }' >"$work/selected"
[[ "$(cat "$work/selected")" == "\"$isa\"," ]] ||
  { echo "not $isa is selected but $(cat "$work/selected")"; exit 1; }

"${emulated[@]}" "$program" render "$scene" -o "$work/emulated.ppm" --size 48x27 --spp 1 -q 2>"$work/err" ||
  { cat "$work/err"; exit 1; }
"$program" render "$scene" -o "$work/native.ppm" --size 48x27 --spp 1 -q
cmp "$work/emulated.ppm" "$work/native.ppm"
echo "$isa is selected and renders the same picture"
