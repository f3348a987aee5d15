#!/usr/bin/env bash
# thread.sh SOURCE BUILD: all parallel code under the thread sanitizer: the library's tests of it, and
# the program, rendering with several threads. 77: the sanitizer cannot run here (GCC 12's needs
# addresses without randomisation). OpenImageIO's threads are left out: it is built without the
# sanitizer, so what its own atomics order would be reported as races.
set -euo pipefail
source="$1" build="$2"
export TSAN_OPTIONS="halt_on_error=1 exitcode=66 ignore_noninstrumented_modules=1"

setarch -R true 2>/dev/null || { echo "addresses cannot be kept in their places (setarch -R)"; exit 77; }
cmake --preset tsan -S "$source" -B "$build" >/dev/null
cmake --build "$build" -j 2 --target boule_program boule_test_render boule_test_path \
  boule_test_cli_time
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
for method in whitted path; do
  for order in tiles progressive; do
    setarch -R "$build/bin/boule" render "$source/scenes/first_light.toml" -o "$work/picture.exr" \
      --size 160x90 --spp 2 -t 5 -q --tile 16 --method "$method" --order "$order"
  done
done
setarch -R "$build/tests/render/boule_test_render" \
  --gtest_filter='Scheduler*:Renderer*:Live*:Tracer*:Picture.*:Determinism.*Rays*'
setarch -R "$build/tests/render/boule_test_path"
setarch -R "$build/tests/render/apps/cli/boule_test_cli_time" --gtest_filter='-*DeathTest*'
