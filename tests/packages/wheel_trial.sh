#!/usr/bin/env bash
# wheel_trial.sh WHEEL CHROOT: a wheel in a root that has Python, pip and numpy and none of Boule's
# libraries, as one who has another distribution meets it. As root. CHROOT, for the same CPython:
#   debootstrap --variant=minbase --include=python3,python3-pip,python3-numpy bookworm CHROOT
# or another system's name, with --components=main,universe where pip is there.
# The program and the package render and trace there; nothing of the build machine is seen.
set -euo pipefail
wheel=$(realpath "$1") root=$(realpath "$2")
scenes=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../scenes")
# shellcheck source=tests/packages/root.sh
source "$(dirname "${BASH_SOURCE[0]}")/root.sh"
cp "$wheel" "$scenes/first_light.toml" "$scenes/crambin.xyz" "$root/trial/"
cat >"$root/trial/inside.sh" <<'INSIDE'
set -euo pipefail
cd /trial
fail() { echo "wheel trial: $1"; exit 1; }
# As variables: the pip of older systems lacks these options.
export PIP_BREAK_SYSTEM_PACKAGES=1 PIP_ROOT_USER_ACTION=ignore
SECONDS=0
pip install --quiet --force-reinstall --no-index --no-deps ./*.whl
boule render first_light.toml -o first_light.png -q
echo "from pip install to a picture: $SECONDS s"
python3 -m boule render crambin.xyz -o crambin.png --size 320x240 -q
[[ "$(head -c 4 crambin.png)" == $'\x89PNG' ]] || fail "crambin.png is no picture"
python3 - <<'PYTHON'
import numpy as np
import boule

scene = boule.load("first_light.toml")
boule.render(scene, size=(160, 90)).save("python.png")
hits = boule.Tracer([[0.0, 0, 0]], 1.0).closest([[0, 0, 5]], [[0, 0, -1]])
assert hits.t[0] == 4 and hits.id[0] == 0, hits
np.savez("balls.npz", centers=np.eye(3))  # libzip is inside
PYTHON
boule render first_light.toml -o other.exr -q 2>err && fail "an EXR without OpenImageIO"
grep -qi openimageio err || fail "what EXR needs is not said: $(cat err)"
for file in $(python3 -c 'import boule, pathlib; p = pathlib.Path(boule.__file__).parent; print(*p.glob("_core*.so"), p / "bin/boule")'); do
  ! ldd "$file" | grep -E "not found" || fail "$file lacks a library"
done
pip uninstall --quiet --yes boule
[[ ! -e /usr/local/bin/boule ]] || fail "the program stays"
INSIDE
env -i PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 chroot "$root" bash /trial/inside.sh
cp "$root/trial/first_light.png" "$(dirname "$wheel")/trial_first_light.png"
echo "the wheel works in $root"
