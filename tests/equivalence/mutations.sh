#!/usr/bin/env bash
# mutations.sh SOURCE BUILD: takes the bounds of filter_bounds.h away, one by one, and breaks ways that
# few rays go. The equivalence tests must see it every time, and must pass where nothing is changed.
set -euo pipefail
source="$1" build="$2"
copy="$build/source"
rm -rf "$copy"
mkdir -p "$copy"
cp -r "$source"/{CMakeLists.txt,CMakePresets.json,README.md,CHANGELOG.md,LICENSE,bench,core,docs,render,scenes,simd,tests} "$copy"
cmake -G Ninja -S "$copy" -B "$build/build" -DCMAKE_BUILD_TYPE=Release \
  -DBOULE_RENDER=OFF -DBOULE_TESTS=ON -DBOULE_WERROR=ON >/dev/null
bounds="simd/abi/filter_bounds.h"
tests=$build/build/tests/equivalence/boule_test_equivalence

passes() {
  cmake --build "$build/build" --target boule_test_equivalence >"$build/log" || { cat "$build/log"; exit 1; }
  "$tests" --gtest_brief=1 --gtest_filter='-*RejectSweep*' >"$build/log" 2>&1
}

passes || { echo "unchanged: the tests fail"; cat "$build/log"; exit 1; }
survivors=0
# mutate NAME FILE SCRIPT: changes a file by a script for sed.
mutate() {
  sed -E "$3" "$source/$2" >"$copy/$2"
  if cmp -s "$source/$2" "$copy/$2"; then
    echo "$1: nothing to change"
    survivors=$((survivors + 1))
  elif passes; then
    echo "$1: not seen"
    survivors=$((survivors + 1))
  else
    echo "$1: seen by $(grep -c '^\[  FAILED  \].*(' "$build/log") tests"
  fi
  cp "$source/$2" "$copy/$2"
}

while read -r name value; do
  mutate "$name = $value" "$bounds" "s/(inline constexpr (double|float) $name = )[^;]+;/\1$value;/"
done <<'BOUNDS'
slack 0
slack_on_the_spot 0
squared_floor 0
floor 0
limit 3e38F
slab_least 0
beam 0
reach 0
spread 0
box 0
box_step 0
moved_box 0
moved_least 0
bundle_axis 0
bundle_square 0
bundle_depth 0
bundle_double 0
bundle_twice 0
bundle_side 1
bundle_side_parallel 0.9F
bundle_shift_slope 0
bundle_end 0
bundle_width 100
bundle_across 1e9F
bundle_far 1e38F
BOUNDS
mutate "rays of sparse bundles are lost" simd/kernel/search/bundle_stream.h \
  's/\.run\(begin, end\)/.run(end, end)/'
mutate "shadow rays that are not sorted are lost" simd/kernel/search/shadow_stream.h \
  's/trace_scattered\(geometry, stream, begin, end, /trace_scattered(geometry, stream, end, end, /'
mutate "groups that are not done are taken for done" simd/kernel/search/bundle_walk.h \
  's/(hits_\.limits\(\), extent, near\[k\]\) )!= 0/\1== 0/'
mutate "one ray alone enters a child" simd/kernel/search/ray_by_ray.h \
  's/return all_lanes & ~(bits\(\(rows & .*\));/return all_lanes \& ~\1 \& 1U;/'
mutate "rays never meet the sphere that they leave inside" simd/kernel/search/scan.h \
  's/if \(\(leaving & rays\.inside\) != 0\)/if (false)/'
mutate "the second of two packets meets nothing" simd/kernel/search/short_search.h \
  's/const unsigned of_packet = (.*)\(lanes, p\);/const unsigned of_packet = p == 0 ? \1(lanes, p) : 0;/'
mutate "short rays miss the last of sixteen spheres that are scanned" simd/kernel/search/traverse.h \
  's/(<< left\) - 1 : )~0U;/\10x7fffU;/'
mutate "two packets reach no lower than the first" simd/kernel/search/reach_box.h \
  's/low_\[axis\] = low\[axis\];//'
mutate "rays tested one by one have no slack along their way" simd/kernel/search/root_bounds.h \
  's/(four_spreads = )[^;]+;/\10.0F;/; s/(outward = )[^;]+;/\11.0F;/'
mutate "spheres beyond the range of the filters are tested one by one" simd/kernel/search/ray_by_ray.h \
  's/may_ = extent < filter::limit && /may_ = extent < 3e38F \&\& /'
mutate "of a list of a set only the first W rays enter children" simd/kernel/search/ray_sets.h \
  's/first < count; first \+= width/first < 1; first += width/'
mutate "lists of a set overlap" simd/kernel/search/ray_sets.h \
  's/top \+= count;/top += count - 1;/'
mutate "rays of sets never meet the sphere that they leave inside" simd/kernel/search/ray_sets.h \
  's/again = own & uniform\(ray\.inside\)/again = own \& uniform(false)/'
mutate "a set never makes room for candidates" simd/kernel/search/set_candidates.h \
  's/return size_ > most;/return false;/'
exit $((survivors != 0))
