#!/usr/bin/env bash
# run.sh SOURCE BUILD SECONDS|daily [NAME...]: builds the fuzzers with clang++ and runs each of them, or
# those named, for so many seconds from the inputs in corpus/ on. Findings are left in BUILD/findings.
# daily: so many inputs of one seed as take some ten seconds, the same on every machine.
# The fuzzer of pictures runs only if named: it also finds faults of OpenImageIO and the libraries below.
set -euo pipefail
source="$1" build="$2" effort="$3"
shift 3
names=("$@")
((${#names[@]} > 0)) || names=(toml nff npy lens particles options view rays packed)

declare -A daily_inputs=([toml]=3000 [nff]=6000 [npy]=8000 [lens]=2000 [particles]=6000 [options]=500
  [rays]=500 [view]=4000 [packed]=3000 [picture]=1000)

command -v clang++ >/dev/null || { echo "clang++ is missing"; exit 77; }
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
  clang++ -x c++ -fsanitize=fuzzer - -o /dev/null 2>/dev/null ||
  { echo "clang++ has no libFuzzer"; exit 77; }

cmake --preset fuzz -G Ninja -S "$source" -B "$build" >/dev/null
cmake --build "$build" --target fuzzers
mkdir -p "$build/findings"
for name in "${names[@]}"; do
  # What was found before goes on by hand only: it would change the daily inputs.
  found="$build/found/$name" amount=(-max_total_time="$effort")
  if [[ "$effort" == daily ]]; then
    found="$build/daily/$name" amount=(-runs="${daily_inputs[$name]}" -seed=1)
    rm -rf "$found"
  fi
  mkdir -p "$found"
  echo "== fuzz_$name, $effort"
  # Each input within 512 MiB (and 5 s: input_budget.h). A picture reserves what its header says, and takes what is
  # in the file; what OpenImageIO leaks is not ours.
  limits=(-rss_limit_mb=512 -malloc_limit_mb=256)
  [[ "$name" != picture ]] || limits=(-rss_limit_mb=512 -malloc_limit_mb=65536 -detect_leaks=0)
  # A packed scene has some pages of names and numbers.
  length=4096
  [[ "$name" != packed ]] || length=12288
  "$build/fuzz/fuzz_$name" "$found" "$source/tests/fuzz/corpus/$name" \
    "${amount[@]}" -timeout=300 "${limits[@]}" -max_len="$length" \
    -artifact_prefix="$build/findings/$name-" -print_final_stats=1 -verbosity=0 ||
    { echo "fuzz_$name found something: exit code $?"; exit 1; }  # its own would mean: skipped
done
