#!/usr/bin/env bash
# inside.sh: what trial.sh does in the root, where /trial has the packages and tests/consumer.
set -euo pipefail
cd /trial
readonly hits='ray 0: primitive 0 at t = 5
ray 1: primitive 1 at t = 0.5
ray 2: primitive -1 at t = inf'

fail() {
  echo "packages: $1" >&2
  exit 1
}
install() { apt-get install -q -y --no-install-recommends "$@" >>log 2>&1 || { cat log; fail "cannot install $*"; }; }
is_picture() { # PNG or JPEG
  [[ "$(head -c 3 "$1" | od -An -tx1)" =~ ^\ (89 50 4e|ff d8 ff)$ ]] || fail "$1 is no picture"
}
# Files that are there, but for those that apt and dpkg keep, and what systems make as they run.
files() {
  find / -xdev \( -path /proc -o -path /dev -o -path /sys -o -path /tmp -o -path /trial -o -path /run \
    -o -path /var/lib/dpkg -o -path /var/lib/apt -o -path /var/cache -o -path /var/log \) -prune \
    -o -print | sort
}
# example_says COMMAND...: runs it; its hits are exact, its picture is there.
example_says() {
  rm -f example.jpg
  [[ "$("$@")" == "$hits" ]] || fail "$* says other hits"
  is_picture example.jpg
}

apt-get update -q >log
dpkg --purge python3-boule libboule-dev libboule2.0 boule-mpi boule-image-formats boule >>log 2>&1  # what a failed trial left
# What the packages need is installed before, so that what is left at the end is theirs.
depends=$(for deb in *.deb; do dpkg-deb -f "$deb" Depends; done | tr ',' '\n' | sed 's/(.*)//; s/|.*//; s/ //g' |
  grep -vE '^(boule|libboule2.0|)$' | sort -u)
# shellcheck disable=SC2086 # one word each
install $depends g++ cmake ninja-build pkg-config openmpi-bin mpich man-db
files >before

echo "packages: boule"
install ./boule_*.deb
boule --version
boule render /usr/share/boule/scenes/first_light.toml -o first.png --size 64x36 -q
is_picture first.png
sha256sum first.png
cp -r /usr/share/boule/scenes mine  # as the manual says
(cd mine && boule render crambin.xyz -o ../crambin.png --size 64x48 --spp 1 -q)
is_picture crambin.png
for page in 'boule' 'boule-'{render,trace,info,view,pack,merge} '5 boule-scene'; do
  # shellcheck disable=SC2086 # section and name
  man $page >page.txt && [[ "$(wc -l <page.txt)" -gt 20 ]] || fail "man $page shows nothing"
done
for command in render trace info view pack merge scene; do
  boule help "$command" >help.txt && grep -q "boule $command" help.txt || fail "boule help $command shows nothing"
done
for file in bash-completion/completions/boule fish/vendor_completions.d/boule.fish \
  zsh/vendor-completions/_boule doc/boule/docs/library.md doc/boule/copyright; do
  [[ -s /usr/share/$file ]] || fail "/usr/share/$file is missing"
done
boule render mine/first_light.toml -o no.exr --size 64x36 -q 2>err && fail "an EXR without boule-image-formats"
grep -q OpenImageIO err || fail "what an EXR needs is not said: $(cat err)"
install ./boule-image-formats_*.deb
boule render mine/first_light.toml -o first.exr --size 64x36 -q
# All that the manual's pages lead to is there.
bash docs/links.sh /usr/share/doc/boule installed || fail "links of the manual lead nowhere"

echo "packages: libboule-dev"
# Programs with the library stay where the program is another version, of the same module.
needs=$(dpkg-deb -f libboule2.0_*.deb Depends Recommends)
! grep -qE 'boule \(|\(= ' <<<"$needs" || fail "libboule2.0 needs one version: $needs"
module=$(dpkg-deb -f boule-image-formats_*.deb Provides)
[[ $module == boule-image-module-[0-9]* && "$needs" == *"Recommends: $module"* ]] || fail "'$module' is not recommended: $needs"
install ./libboule2.0_*.deb ./libboule-dev_*.deb
for kind in boule shared; do
  cmake -S consumer/find_package -B "build-$kind" -G Ninja -DBOULE_LIBRARY="boule::$kind" >>log
  cmake --build "build-$kind" >>log
  example_says "build-$kind/example"
done
source=/usr/share/doc/libboule-dev/examples/example.cpp
g++ -std=c++20 "$source" -o by-shared $(pkg-config --cflags --libs boule)
g++ -std=c++20 "$source" -o by-static $(pkg-config --cflags --libs boule-static)
example_says ./by-shared
cp "$(pkg-config --variable=image_module boule-static)" .
example_says ./by-static
for program in by-shared build-shared/example; do
  readelf -d "$program" | grep -q 'NEEDED.*libboule.so.2.0' || fail "$program does not use the shared library"
done
for program in by-static build-boule/example; do
  if readelf -d "$program" | grep -q libboule; then fail "$program uses the shared library"; fi
done

echo "packages: python3-boule"
install ./python3-boule_*.deb
(
  cd / && python3 - <<'PYTHON'
import boule
import numpy

hits = boule.Tracer([[0, 0, 0]], 1).closest([[0, 0, 5]], [[0, 0, -1]])
assert numpy.asarray(hits.t)[0] == 4, hits.t
picture = boule.render(boule.load("/usr/share/boule/scenes/first_light.toml"), size=(64, 36))
picture.save("/trial/python.png")
PYTHON
)
is_picture python.png

echo "packages: boule-mpi"
install ./boule-mpi_*.deb
for mpirun in mpirun.openmpi mpirun.mpich; do
  rm -f team.png
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
    "$mpirun" -n 2 boule render /usr/share/boule/scenes/first_light.toml -o team.png --size 64x36 2>team.log ||
    { cat team.log; fail "$mpirun ends with $?"; }
  cmp first.png team.png || fail "$mpirun renders another picture"
done

apt-get purge -q -y boule boule-mpi boule-image-formats libboule2.0 libboule-dev python3-boule >>log
rm -rf /root/.cache
files >after
diff before after || fail "something is left, or gone"
echo "packages: $(ls ./*.deb | wc -l) packages were installed, used and removed without a trace"
