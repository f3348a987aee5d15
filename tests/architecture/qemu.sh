#!/usr/bin/env bash
# qemu.sh QEMU CPU ISA EQUIVALENCE_TEST [PROGRAM SCENE]: on that CPU the ISA is selected, some of its tests
# pass (a stray instruction of a wider one is a SIGILL), and the program renders.
set -euo pipefail
emulated=("$1" -cpu "$2") isa="$3" equivalence="$4" program="${5:-}" scene="${6:-}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
unset BOULE_ISA

# That no object has an instruction of a wider set is seen without a CPU (instructions.sh), and that
# its kernels find the right bits where it is at home. Here each way through the kernels is gone
# a few times.
some=(Kernels.HashOf\*PrimaryRays LaneIndependence PrimaryRays SobolKernels SurfacesAre SurfacesMatch SurfacesOfSpecks
  MeetsSpheresAtTheEye LooksEverywhere MakeFewTrials OverflowingCandidates EndsOnTheSurface
  GoesAsPacketsPastParts TangentsAtTheOrigin UnnamedEnumerators RaysOfOddCameras)
hard=(S0_k0 S4_k12 S12_k0 P0_k0 L_k3)  # cases of hard_cases.h: every form, surfaces
filter="$(printf "*%s*/$isa*:" "${some[@]}")$(printf "*/${isa}_%s:" "${hard[@]}")-*HardBundles*"
"${emulated[@]}" "$equivalence" --gtest_filter="$filter" >"$work/out" 2>"$work/err" ||
  { tail -n 30 "$work/out" "$work/err"; exit 1; }
tail -n 1 "$work/out"
grep -qE '^\[  PASSED  \] [1-9]' "$work/out" || { echo "no test of $isa ran"; exit 1; }
for name in "${some[@]}" "${hard[@]/#/${isa}_}"; do
  grep -q "^\[ RUN .*${name/\*/.*}" "$work/out" || { echo "no test $name of $isa ran"; exit 1; }
done
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
