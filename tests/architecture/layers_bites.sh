#!/usr/bin/env bash
# Proves that layers.sh bites: a tree with exactly one fault, once per rule, must be refused with
# the fault's own words, and the same tree without it must pass.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

fresh_tree() {
  rm -rf "$work/tree"
  mkdir -p "$work/tree"/{core,simd,render,tests,bench}
  echo '#include <vector>' >"$work/tree/core/scene.h"
}

# put PATH TEXT: a file of the tree.
put() {
  mkdir -p "$work/tree/$(dirname "$1")"
  printf '%s\n' "$2" >"$work/tree/$1"
}

# refused PATH TEXT WORDS: this file's text must be refused with these words.
refused() {
  fresh_tree
  put "$1" "$2"
  if "$here/layers.sh" "$work/tree" >"$work/out" 2>&1; then
    echo "NOT REFUSED: $1: $2"
    failures=$((failures + 1))
  elif ! grep -qF "$3" "$work/out"; then
    echo "WRONG WORDS: $1: $2"
    cat "$work/out"
    failures=$((failures + 1))
  fi
}

# accepted PATH TEXT: this file's text must pass.
accepted() {
  fresh_tree
  put "$1" "$2"
  if ! "$here/layers.sh" "$work/tree" >"$work/out" 2>&1; then
    echo "REFUSED: $1: $2"
    cat "$work/out"
    failures=$((failures + 1))
  fi
}

# Upward and sideways.
refused render/apps/cli/a.cpp '#include "render/apps/python/values/call.h"' 'may not include'
refused render/apps/python/a.cpp '#include "render/apps/cli/process/interrupt.h"' 'may not include'
refused render/apps/python/a.cpp '#include "render/integrators/path.h"' 'may not include'
accepted render/apps/python/a.cpp '#include "render/apps/job/scene_loader.h"'
refused render/renderer/a.cpp '#include <pybind11/pybind11.h>' 'Python has another owner'
refused core/a.h '#include "simd/abi/isa.h"' 'may not include simd/abi/isa.h'
refused core/a.h '#include <fmt/format.h>' 'may not include <fmt/format.h>'
refused core/a.h '#include <unistd.h>' 'may not include <unistd.h>'
refused simd/abi/a.h '#include "core/math/warp.h"' 'may not include'
refused simd/abi/a.h '#include <vector>' 'may not include <vector>'
refused simd/geometry/a.cpp '#include "simd/kernel/search/leaf/scan.h"' 'may not include'
refused simd/geometry/a.cpp '#include "simd/dispatch/cpu.h"' 'may not include'
refused simd/dispatch/a.cpp '#include "simd/lanes/lanes.h"' 'may not include'
refused simd/dispatch/a.cpp '#include "simd/geometry/geometry.h"' 'may not include'
refused simd/lanes/a.h '#include "simd/kernel/search/leaf/ray_lanes.h"' 'may not include'
refused simd/lanes/a.h '#include <string>' 'may not include <string>'
refused simd/kernel/a.h '#include <vector>' 'may not include <vector>'
refused simd/kernel/a.h '#include <algorithm>' 'may not include <algorithm>'
refused simd/kernel/a.h '#include "core/scene/scene.h"' 'may not include'
refused simd/kernel/a.h '#include "core/optics/camera_ray.h"' 'may not include'
refused core/math/warp.h '#include <vector>' 'may not include <vector>'
refused core/optics/cameras.h '#include "core/scene/camera.h"' 'may not include'
refused simd/kernel/a.h '#include "simd/stream/aligned_array.h"' 'may not include'
refused simd/geometry/a.cpp '#include "render/image/image.h"' 'may not include'
refused render/prepare/a.cpp '#include "simd/kernel/search/leaf/scan.h"' 'may not include'
refused render/files/scene_file/a.cpp '#include "simd/abi/isa.h"' 'may not include'
refused render/files/scene_file/a.cpp '#include "render/image/write_image.h"' 'may not include'
refused render/image/a.cpp '#include "render/frame/film.h"' 'may not include'
refused render/frame/a.cpp '#include "render/shading/bsdf.h"' 'may not include'
refused render/files/trace_file/a.cpp '#include "render/renderer/tracer.h"' 'may not include'
refused render/renderer/a.cpp '#include "render/files/trace_file/ray_file.h"' 'may not include'
refused render/prepare/a.cpp '#include "render/shading/bsdf.h"' 'may not include'
refused render/shading/a.cpp '#include "render/integrators/whitted.h"' 'may not include'
refused render/integrators/a.cpp '#include "render/renderer/renderer.h"' 'may not include'
refused render/renderer/a.cpp '#include "render/files/scene_file/scene_file.h"' 'may not include'
refused render/renderer/a.cpp '#include "render/apps/cli/options/options.h"' 'may not include'
refused tests/render/a.cpp '#include "render/apps/cli/options/options.h"' 'may not include'
refused tests/fuzz/fuzz_toml.cpp '#include "render/apps/cli/options/options.h"' 'may not include'
refused tests/equivalence/a.cpp '#include "simd/kernel/search/leaf/scan.h"' 'may not include'
refused tests/simd/stream/stream_test.cpp '#include "simd/lanes/lanes.h"' 'may not include'
refused tests/simd/lanes/lanes_test.cpp '#include "simd/kernel/search/leaf/scan.h"' 'may not include'
refused tests/core/a.cpp '#include "simd/abi/isa.h"' 'may not include'
refused tests/core/a.cpp '#include "tests/simd/a.h"' 'may not include'
refused tests/simd/a.cpp '#include "render/image/image.h"' 'may not include'
refused tests/equivalence/a.cpp '#include "render/image/image.h"' 'may not include'
refused tests/support/a.h '#include "render/image/image.h"' 'may not include'
refused bench/a.cpp '#include "simd/lanes/lanes.h"' 'may not include'
refused render/new_folder/a.cpp '#include <vector>' 'belongs to no layer'

# How an include is written.
refused core/a.h '#include "vec.h"' 'not written from the root'
refused core/math/a.h '#include "../base/error.h"' 'not written from the root'
refused core/math/a.h '  #  include "core/../base/error.h"' 'not written from the root'

# One owner per outside thing.
refused simd/kernel/a.h '#include <xsimd/xsimd.hpp>' 'xsimd has another owner'
refused simd/lanes/lanes.h '#include <xsimd/xsimd.hpp>' 'xsimd has another owner'
refused render/image/tone.cpp '#include <OpenImageIO/imageio.h>' 'OpenImageIO has another owner'
refused render/frame/scheduler.cpp '#include <thread>' 'threads has another owner'
refused render/image/tone.cpp 'auto later = std::async(work);' 'threads has another owner'
refused simd/dispatch/dispatch.cpp '#include <cpuid.h>' 'CPUID has another owner'
refused render/apps/cli/a.cpp 'if (__builtin_cpu_supports("avx2")) run();' 'CPUID has another owner'
refused render/renderer/a.cpp '#include <iostream>' 'the terminal has another owner'
refused core/a.cpp 'std::printf("hello");' 'the terminal has another owner'
refused core/a.cpp 'fprintf(stderr, "hello");' 'the terminal has another owner'
refused render/image/a.cpp 'std::cerr << "no";' 'the terminal has another owner'
refused render/image/a.cpp 'write(STDERR_FILENO, "no", 2);' 'the terminal has another owner'
refused core/a.cpp 'std::fwrite("no", 1, 2, stderr);' 'the terminal has another owner'
refused core/a.cpp 'dprintf(2, "no");' 'the terminal has another owner'
refused render/image/a.cpp 'if (bad) std::exit(1);' 'the end of the process has another owner'
refused core/a.cpp '  abort();' 'the end of the process has another owner'
refused core/a.cpp '#include <cassert>' 'the end of the process has another owner'
refused core/a.cpp 'assert(i < n);' 'the end of the process has another owner'
refused simd/geometry/a.h 'if (i >= n) __builtin_trap();' 'the end of the process has another owner'
refused render/frame/a.cpp 'std::raise(SIGTERM);' 'the end of the process has another owner'
refused render/image/a.cpp 'const char* home = std::getenv("HOME");' 'the environment has another owner'
refused simd/kernel/a.h '#define WIDTH 8' 'a macro has another owner'
refused tests/core/a.cpp '#  define CHECK(x) x' 'a macro has another owner'

# The other side of the rules.
accepted core/a.cpp 'std::snprintf(buffer, sizeof buffer, "%g", value);'
accepted core/a.cpp '// printf("x") and std::exit(1) are only spoken of'
accepted core/a.cpp 'text = "std::exit(1) // and printf(";'
accepted core/a.cpp 'static_assert(sizeof(int) == 4);'
accepted simd/kernel/a.h '#include "core/optics/cameras.h"'
accepted core/optics/cameras.h '#include "core/math/elementary.h"'
accepted simd/abi/a.h '#include "core/optics/camera_view.h"'
accepted simd/lanes/xsimd_lanes.h '#include <xsimd/xsimd.hpp>  // its owner'
accepted render/threads/threads.cpp '#include <thread>'
accepted render/image/module/image_module.cpp '#include <OpenImageIO/imageio.h>'
accepted render/image/module/module_writer.h '#include <OpenImageIO/imageio.h>'
accepted render/files/scene_file/a.cpp '#include "render/image/read_image.h"'
accepted simd/dispatch/cpu.cpp '#include <cpuid.h>'
accepted render/apps/cli/main.cpp 'std::exit(2);'
accepted tests/simd/lanes/lanes_test.cpp '#include "simd/lanes/lanes.h"'
accepted tests/fuzz/fuzz_options.cpp '#include "render/apps/cli/options/options.h"'
accepted tests/render/apps/cli/options/options_test.cpp '#include "render/apps/cli/options/options.h"'
accepted tests/render/apps/cli/a.cpp '#include "render/apps/cli/process/pulse.h"'
accepted tests/render/a.cpp '#include <thread>'

((failures == 0)) || { echo "$failures faults slipped through"; exit 1; }
echo "every rule bites"
