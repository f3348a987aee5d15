#!/usr/bin/env bash
# mutations.sh SOURCE BUILD [PATTERN]: takes the bounds of filter_bounds.h away, one by one, and breaks ways that
# few rays go. The equivalence tests must see it every time, and must pass where nothing is broken.
# One program serves for all: a copy of the source asks the environment which of its mutants it is,
# BOULE_MUTANT. It has all instruction sets: some ways are of four lanes alone, some of sixteen.
# PATTERN: only mutants whose names match this extended regular expression.
set -euo pipefail
source="$1" build="$2" pattern="${3:-.}"
copy="$build/source"
bounds="simd/abi/filter_bounds.h"
tests="$build/build/tests/equivalence/boule_test_equivalence"
rm -rf "$copy"
mkdir -p "$copy"
cp -r "$source"/{CMakeLists.txt,CMakePresets.json,README.md,CHANGELOG.md,LICENSE,bench,core,docs,render,scenes,simd,tests} "$copy"
: >"$build/mutants"

# change FILE SCRIPT: changes a file of the copy by a script for sed, which must find something.
change() {
  cp "$copy/$1" "$build/before"
  sed -E -i "$2" "$copy/$1"
  ! cmp -s "$build/before" "$copy/$1" || { echo "$1: nothing to change by $2"; exit 1; }
}

# ---- Mutants -----------------------------------------------------------------------------------

# Bounds are variables.
change "$bounds" 's/^inline constexpr (double|float) (\w+) = /inline const \1 \2 = /'
for file in $(cd "$copy" && grep -rlE 'constexpr .*filter::' simd); do
  change "$file" 's/static constexpr (.*filter::)/static inline const \1/; s/constexpr (.*filter::)/const \1/'
done
change "$bounds" '/^namespace boule::filter/a\
/// Whether the program is the mutant NAME, or "NAME VALUE".\
static bool is_mutant(const char* name) {\
  const char* const mutant = std::getenv("BOULE_MUTANT");\
  const std::size_t size = std::strlen(name);\
  if (mutant == nullptr || std::strncmp(mutant, name, size) != 0) return false;\
  return mutant[size] == 0 || mutant[size] == 32;\
}\
template <typename Real>\
static Real mutated(const char* name, Real value) {\
  if (!is_mutant(name)) return value;\
  return static_cast<Real>(std::strtod(std::getenv("BOULE_MUTANT") + std::strlen(name), nullptr));\
}'
change "$bounds" '0,/^#include/s/^#include/#include <cstdlib>\n#include <cstring>\n#include/'

while read -r name value; do
  change "$bounds" "s/(inline const (double|float) $name = )([^;]+);/\1mutated<\2>(\"$name\", \3);/"
  echo "$name $value" >>"$build/mutants"
done <<'BOUNDS'
slack 0
slack_on_the_spot 0
squared_floor 0
floor 0
limit 3e38
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
bundle_side_parallel 0.9
bundle_shift_slope 0
bundle_end 0
bundle_width 100
bundle_across 1e9
bundle_far 1e38
capsule 0
aside 0
BOUNDS

# breaks NAME FILE SCRIPT: BROKEN stands for whether the program is this mutant.
breaks() {
  local broken="broken_$(wc -l <"$build/mutants")"
  local file
  file="$(cd "$copy" && ls simd/kernel/search/*/"$2")"
  change "$file" "${3//BROKEN/filter::$broken}"
  change "$file" '0,/^#include/s//#include "simd\/abi\/filter_bounds.h"\n#include/'
  change "$bounds" "s/^}  \/\/ namespace/inline const bool $broken = is_mutant(\"$1\");\n&/"
  echo "$1" >>"$build/mutants"
}
breaks "rays of sparse bundles are lost" bundle_stream.h \
  's/(trace_scattered\(geometry, stream, )begin, (end, Form::set)/\1BROKEN ? end : begin, \2/'
breaks "shadow rays that are not sorted are lost" shadow_stream.h \
  's/(trace_scattered\(geometry, stream, )begin, (end, Form::automatic)/\1BROKEN ? end : begin, \2/'
breaks "shadow rays that no sorted bundle takes are lost" shadow_stream.h \
  's/(trace_unanswered\(geometry, stream, )begin, (end, known)/\1BROKEN ? end : begin, \2/'
breaks "a trial of fewer than four sorted bundles judges none" shadow_stream.h \
  's/if \(k >= bundles\.judges\(\)\) continue;/if (k >= bundles.judges() || (BROKEN \&\& bundles.size() < 4)) continue;/'
breaks "the last sphere beside a tree is not scanned" scan.h \
  's/while \(size > 0 && spheres\.id\[size - 1\] < 0\) --size;/&\n  if (BROKEN \&\& size > 0) --size;/'
breaks "groups that are not done are taken for done" bundle_walk.h \
  's/if \((groups_near\(.*hits_\.limits\(\), extent, near\[k\]\) != 0)\)/if ((\1) != BROKEN)/'
breaks "one ray alone enters a child" ray_by_ray.h \
  's/return all_lanes & ~bits\(\(rows & .*\);/if (BROKEN) return 1;\n&/'
breaks "rays never meet the sphere that they leave inside" scan.h \
  's/if \(\(leaving & rays\.inside\) != 0\)/if (!BROKEN \&\& (leaving \& rays.inside) != 0)/'
breaks "the second of two packets meets nothing" short_search.h \
  's/const unsigned of_packet = (.*\(lanes, p\));/const unsigned of_packet = BROKEN \&\& p != 0 ? 0 : \1;/'
breaks "short rays miss the last of sixteen spheres that are scanned" traverse.h \
  's/(<< left\) - 1 : )~0U;/\1BROKEN ? 0x7fffU : ~0U;/'
breaks "two packets reach no lower than the first" reach_box.h \
  's/low_\[axis\] = low\[axis\];/if (!BROKEN) &/'
breaks "rays tested one by one have no slack along their way" root_bounds.h \
  's/(four_spreads = )([^;]+);/\1BROKEN ? 0.0F : \2;/; s/(outward = )([^;]+);/\1BROKEN ? 1.0F : \2;/'
breaks "spheres beyond the range of the filters are tested one by one" ray_by_ray.h \
  's/may_ = extent < filter::limit && /may_ = extent < (BROKEN ? 3e38F : filter::limit) \&\& /'
breaks "rays turned round go on behind their end" ray_range.h \
  's/greatest_lane\(tmax\.high\) <= 1\.0F/BROKEN || &/'
breaks "a few capsules are half as wide for rays with an apex" capsules_near.h \
  's/const double sine = \(radius \+/const double sine = ((BROKEN ? 0.5 : 1.0) * radius +/'
breaks "children of the root of capsules are all leaves" capsules_near.h \
  's/(near\.listed = )(root\.leaf_size\[child\] != 0;)/\1BROKEN || \2/'
breaks "of a list of a set only the first W rays enter children" ray_sets.h \
  's/first < count; first \+= width/first < (BROKEN ? 1 : count); first += width/'
breaks "lists of a set overlap" ray_sets.h \
  's/top \+= count;/top += BROKEN ? count - 1 : count;/'
breaks "rays of sets never meet the sphere that they leave inside" ray_sets.h \
  's/again = own & uniform\(ray\.inside\)/again = own \& uniform(!BROKEN \&\& ray.inside)/'
breaks "sorted rays get the primitive of another" sorted_rays.h \
  's/= id_\[k\];/= id_[BROKEN ? 0 : k];/'
breaks "sorted rays go to the places of the first ones" sorted_rays.h \
  's/(static_cast<std::uint32_t>\()begin (\+ k\))/\1(BROKEN ? 0 : begin) \2/'
breaks "a set never makes room for candidates" set_candidates.h \
  's/return size_ > most;/return !BROKEN \&\& size_ > most;/'
breaks "boxes of a leaf's capsules lack their radius" capsule_search.h \
  's/const Real r = (abs\(load\(block\.radius \+ at\)\) \* outward);/const Real r = BROKEN ? Real(0.0F) : \1;/'
breaks "rays that leave a capsule inside do not meet it" capsule.h \
  's/\(leaves & rays\.inside\) \|/(leaves \& rays.inside \& widen(uniform(!BROKEN))) |/'
breaks "a capsule is entered where the line is nearest" capsule.h \
  's/(balls\.meet\(on_segment\(nearest - )lean/\1(BROKEN ? Wide(0.0) : lean)/'

# ---- Judged by the tests -----------------------------------------------------------------------

cmake -G Ninja -S "$copy" -B "$build/build" -DCMAKE_BUILD_TYPE=Release -DBOULE_ONLY_ISAS= \
  -DBOULE_RENDER=OFF -DBOULE_TESTS=ON -DBOULE_WERROR=ON >/dev/null
cmake --build "$build/build" --target boule_test_equivalence >"$build/log" || { cat "$build/log"; exit 1; }

# passes MUTANT LOG
passes() {
  BOULE_MUTANT="$1" "$tests" --gtest_brief=1 --gtest_filter='-*RejectSweep*' >"$2" 2>&1
}
# judge NUMBER MUTANT: whether the tests see it.
judge() {
  local failed
  if ! passes "$2" "$build/log.$1"; then
    failed="$(grep -c '^\[  FAILED  \].*(' "$build/log.$1" || true)"
    echo "$2: seen by $failed tests$( ((failed > 0)) || echo ", the program ends")"
  elif [[ "$2" == *"of sixteen lanes"* ]] && ! grep -q avx512dq /proc/cpuinfo; then
    echo "$2: not tried, this processor has fewer"
  else
    echo "$2: not seen"
    return 1
  fi
}
export tests build
export -f passes judge

passes "none" "$build/log" || { echo "nothing is broken, and tests fail"; cat "$build/log"; exit 1; }
grep -nE "$pattern" "$build/mutants" | sed 's/:/\n/' | xargs -d '\n' -P "$(nproc)" -n 2 bash -c 'judge "$@"' judge
