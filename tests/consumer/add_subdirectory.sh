#!/usr/bin/env bash
# add_subdirectory.sh CMAKE GENERATOR CXX flags=FLAGS SOURCE COMPILE_COMMANDS OPTION...: boule inside an outside
# project, configured with these options, builds neither tests nor benchmarks, installs nothing and leaves the
# project's own flags alone. What the project compiles just as the build of these compile commands did is
# not compiled again.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/outside.sh"
boule="$1" commands="$2"
shift 2

build add_subdirectory -DBOULE_SOURCE="$boule" -DBOULE_ONLY_ISAS=scalar \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$here/compiled_before.sh;$commands" "$@"
inherits hits.cpp "-I$boule"
prints 'ray 0: primitive 0 at t = 5
ray 1: primitive 1 at t = 0.5' "$work/build/hits"

# Only the targets that were asked for are compiled: the others take most of a build's time.
kernels="$(grep -o 'boule_kernel_[a-z0-9]*[.]dir' "$work/build/compile_commands.json" | sort -u | wc -l)"
[[ "$kernels" == 1 ]] || { echo "$kernels instruction sets, expected 1"; exit 1; }

for folder in tests bench; do
  [[ ! -e "$work/build/boule/$folder" ]] || { echo "$folder are part of the build"; exit 1; }
done
"$cmake" --install "$work/build" --prefix "$work/installed" >/dev/null
if find "$work/installed" -type f 2>/dev/null | grep .; then
  echo "installed with the outside project"
  exit 1
fi
