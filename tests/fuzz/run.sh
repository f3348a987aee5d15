#!/usr/bin/env bash
# run.sh SOURCE BUILD SECONDS [NAME...]: builds the fuzzers with clang++ and runs each of them, or
# those named, for so many seconds from the inputs in corpus/ on. Findings are left in BUILD/findings.
# The fuzzer of pictures runs only if named: it also finds faults of OpenImageIO and the libraries below.
set -euo pipefail
source="$1" build="$2" seconds="$3"
shift 3
names=("$@")
((${#names[@]} > 0)) || names=(toml nff npy lens particles options view rays)

command -v clang++ >/dev/null || { echo "clang++ is missing"; exit 77; }
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
  clang++ -x c++ -fsanitize=fuzzer - -o /dev/null 2>/dev/null ||
  { echo "clang++ has no libFuzzer"; exit 77; }

cmake --preset fuzz -G Ninja -S "$source" -B "$build" >/dev/null
cmake --build "$build" --target fuzzers
mkdir -p "$build/findings"
for name in "${names[@]}"; do
  mkdir -p "$build/found/$name"
  echo "== fuzz_$name, $seconds s"
  # Each input within 512 MiB (and 5 s: input_budget.h). A picture reserves what its header says, and takes what is
  # in the file; what OpenImageIO leaks is not ours.
  limits=(-rss_limit_mb=512 -malloc_limit_mb=256)
  [[ "$name" != picture ]] || limits=(-rss_limit_mb=512 -malloc_limit_mb=65536 -detect_leaks=0)
  "$build/fuzz/fuzz_$name" "$build/found/$name" "$source/tests/fuzz/corpus/$name" \
    -max_total_time="$seconds" -timeout=300 "${limits[@]}" -max_len=4096 \
    -artifact_prefix="$build/findings/$name-" -print_final_stats=1 -verbosity=0 ||
    { echo "fuzz_$name found something: exit code $?"; exit 1; }  # its own would mean: skipped
done
