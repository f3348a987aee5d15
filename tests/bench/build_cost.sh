#!/usr/bin/env bash
# build_cost.sh BUILD_COST: sums of a small log of ninja, by part; a job that ran twice counts once.
set -euo pipefail
build_cost="$1"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

fail() {
  echo "$1"
  cat "$work/out"
  exit 1
}
# job BEGIN END OUTPUT: in milliseconds.
job() { printf '%s\t%s\t0\t%s\tabc\n' "$1" "$2" "$3" >>"$work/.ninja_log"; }

"$build_cost" "$work" >"$work/out" 2>&1 && fail "a folder without a log is taken"
grep -q 'there is no such file' "$work/out" || fail "it does not say that there is no log"

echo "# ninja log v5" >"$work/.ninja_log"
job 0 9000 simd/CMakeFiles/boule_kernel_avx2.dir/kernel/packets.cpp.o
job 0 4000 simd/CMakeFiles/boule_kernel_avx2.dir/kernel/packets.cpp.o
job 0 1500 simd/CMakeFiles/boule_simd.dir/geometry/split.cpp.o
job 1500 3000 core/CMakeFiles/boule_core.dir/surface.cpp.o
job 0 2000 render/CMakeFiles/boule.dir/frame/film.cpp.o
job 0 1000 render/apps/cli/CMakeFiles/boule_cli.dir/options.cpp.o
"$build_cost" "$work" --dearest 1 >"$work/out"
for row in '| all | 10 |' '| kernels | 4 |' '| core, simd | 3 |' '| render library | 2 |' '| program | 1 |' \
  '| simd/boule_kernel_avx2/kernel/packets.cpp.o | 4.0 |'; do
  grep -qxF "$row" "$work/out" || fail "without the row $row:"
done
[[ "$(grep -c '[.]o |' "$work/out")" == 1 ]] || fail "more than one dearest job"
echo "build_cost counts each job once"
