#!/usr/bin/env bash
# pip.sh ROOT WORK PYTHON: pip install, offline, into a folder of its own; the package there renders
# without the tree where it was built.
set -euo pipefail
root="$1" work="$2" python="$3"
"$python" -c 'import setuptools, pip, wheel, numpy' || exit 77

rm -rf "$work"
mkdir -p "$work/source"
# A copy: setuptools writes beside its sources.
(cd "$root" && git ls-files -z --cached --others --exclude-standard |
  xargs -0 cp --parents -t "$work/source")
# One instruction set: the others take as long to build and show nothing more.
CMAKE_ARGS="-DBOULE_ONLY_ISAS=scalar" "$python" -m pip install --no-index --no-deps --no-build-isolation --no-cache-dir \
  --target "$work/installed" "$work/source"
rm -rf "$work/source"
ls "$work/installed/boule"
cd "$work"
env PYTHONPATH="$work/installed" "$python" - <<'PYTHON'
import importlib.metadata

import boule

assert "installed" in boule.__file__, boule.__file__
needed = importlib.metadata.distribution("boule").requires
assert needed == [f"numpy<{boule._core.numpy_below},>=1.21"], needed
scene = boule.Scene()
scene.add_sphere()
boule.render(scene, size=(32, 24)).save("ball.png")
assert open("ball.png", "rb").read().startswith(b"\x89PNG")
print("pip: the package is whole")
PYTHON
