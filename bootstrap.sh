#!/usr/bin/env bash
# From a clean clone on Debian 12 to a picture or a tested build: see usage().
set -euo pipefail

# openimageio-tools: the CMake package of libopenimageio-dev refuses to load without its programs.
# lowdown: makes the manual pages.
# clang: the compiler that is taken where it is there; g++ brings its standard library.
readonly build_packages=(cmake clang g++ ninja-build libxsimd-dev libopenimageio-dev openimageio-tools
  libcli11-dev libfast-float-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libzip-dev libzstd-dev zlib1g-dev libbz2-dev liblzma-dev
  gemmi-dev tao-pegtl-dev libboost-dev libhdf5-dev libpango1.0-dev libpng-dev libturbojpeg0-dev libxxhash-dev lowdown)
# libclang-rt-14-dev: libFuzzer and the sanitizers. lammps-examples: particle files by others.
# chromium-driver, python3-selenium: the pages, driven in a browser.
# libopenmpi-dev, libmpich-dev: ranks that work together; the program needs neither.
# bash-completion, fish, zsh, man-db, mandoc: who reads the manual pages and completions.
# doxygen, python3-sphinx: the pages of the target `reference`.
readonly test_packages=(bash-completion binutils chromium-driver clang-format clang-tidy doxygen fish libclang-rt-14-dev libgmock-dev
  libgtest-dev lammps-examples libmpfr-dev libmpich-dev libopenmpi-dev librapidcheck-dev man-db
  mandoc mpich openmpi-bin pkg-config python3-ase python3-gemmi python3-h5py python3-selenium qemu-user zsh)
# For the package boule, and what its tests hold it against.
readonly python_packages=(python3-dev python3-numpy python3-pybind11 pybind11-dev)
readonly python_test_packages=(mypy python3-ase python3-ipykernel python3-matplotlib python3-mdanalysis
  python3-nbclient python3-pytest python3-sphinx)
readonly bench_packages=(libbenchmark-dev libembree-dev libmpfr-dev python3-matplotlib)
readonly wheel_packages=(binutils patchelf python3-pip python3-setuptools python3-wheel)
readonly package_packages=(debhelper dh-python dpkg-dev git libmpich-dev libopenmpi-dev lintian)

usage() {
  cat <<'TEXT'
usage: ./bootstrap.sh render|test|python|wheel|report|package
  render  install what is missing, build the program in build/release, render scenes/first_light.toml to
          first_light.png
  test    install what is missing, build the tests in build/test and run them
  python  install what is missing, build the Python package in build/python, run its tests, say how to
          import it
  wheel   install what is missing, make a wheel in build/wheel that runs on other distributions
  report  install what is missing, build the benchmarks in build/bench, measure speed against error
          (about 10 minutes), write report.html and what the README shows of it
  package install what is missing, make Debian packages and a source tarball of what is committed in
          build/package
TEXT
}

# announce CPU_SECONDS WHAT: what is to be done, and about how long that takes here.
announce() {
  echo "bootstrap: $2; about $((($1 / $(nproc) + 30) / 60 + 1)) minutes here, if packages need not be installed"
}

is_installed() {
  [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

# install_missing PACKAGE...: asks apt only where something is missing. Who may not ask apt gets a line
# for somebody who may.
install_missing() {
  local missing=() package as_root=()
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  ((${#missing[@]} > 0)) || return 0
  if ! command -v apt-get >/dev/null; then
    echo "bootstrap: there is no apt-get here; what Debian calls ${missing[*]} must be installed otherwise" >&2
    exit 1
  fi
  if ((EUID != 0)) && ! command -v sudo >/dev/null; then
    echo "bootstrap: packages are missing, and there is no sudo here; an administrator can run:" >&2
    echo "apt-get update && apt-get install -y --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  echo "bootstrap: installing ${missing[*]}"
  ((EUID == 0)) || as_root=(sudo)
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${missing[@]}"
}

render() {
  announce 400 "compiles the program in build/release and renders first_light.png"
  install_missing "${build_packages[@]}"
  # The picture is the same on every instruction set: the widest that runs here will do.
  cmake --preset release -G Ninja -DBOULE_TESTS=OFF -DBOULE_ONLY_ISAS=native
  cmake --build build/release --target boule_program
  build/release/bin/boule render scenes/first_light.toml -o first_light.png
  echo "bootstrap: the picture is $PWD/first_light.png"
}

run_tests() {
  announce 1800 "compiles Boule and its tests in build/test and runs them"
  install_missing "${build_packages[@]}" "${test_packages[@]}" "${python_packages[@]}" \
    "${python_test_packages[@]}"
  # As users run it, and a warning is an error.
  cmake --preset release -G Ninja -B build/test -DBOULE_TESTS=ON -DBOULE_PYTHON=ON -DBOULE_WERROR=ON
  cmake --build build/test
  # Without the long runs: ctest --test-dir build/test -L long -V
  exec ctest --test-dir build/test -LE long -j2 --output-on-failure
}

# Builds no test program: the package's tests are Python.
python() {
  install_missing "${build_packages[@]}" "${python_packages[@]}" "${python_test_packages[@]}"
  cmake --preset release -G Ninja -B build/python -DBOULE_PYTHON=ON -DBOULE_TESTS=OFF
  cmake --build build/python
  local tests
  for tests in tests/render/apps/python/test_*.py; do
    PYTHONPATH="$PWD/build/python" BOULE_PROGRAM="$PWD/build/python/bin/boule" PYTHONDONTWRITEBYTECODE=1 \
      /usr/bin/python3 tests/render/apps/python/run_pytest.py "$tests"
  done
  echo "bootstrap: import it by  PYTHONPATH=$PWD/build/python /usr/bin/python3 -c 'import boule'"
}

wheel() {
  install_missing "${build_packages[@]}" "${python_packages[@]}" "${wheel_packages[@]}"
  /usr/bin/python3 packaging/wheel.py build/wheel
  echo "bootstrap: install it by  pip install build/wheel/*.whl"
}

report() {
  install_missing "${build_packages[@]}" "${bench_packages[@]}"
  cmake --preset release -G Ninja -B build/bench -DBOULE_BENCH=ON -DBOULE_TESTS=OFF
  cmake --build build/bench --target report
  SOURCE_DATE_EPOCH="$(git log -1 --format=%ct)" build/bench/bin/report -o report.json
  bench/report/publish.py report.json --charts bench/report --readme README.md
  echo "bootstrap: the page is $PWD/report.html, its figures are report.json"
}

package() {
  install_missing "${build_packages[@]}" "${python_packages[@]}" "${package_packages[@]}"
  packaging/package.sh build/package
  echo "bootstrap: install them by  apt-get install ./build/package/*.deb"
}

cd "$(dirname "${BASH_SOURCE[0]}")"
[[ $# -eq 1 ]] || { usage >&2; exit 2; }
case "$1" in
  render) render ;;
  test) run_tests ;;
  python) python ;;
  wheel) wheel ;;
  report) report ;;
  package) package ;;
  -h | --help | help) usage ;;
  *) usage >&2; exit 2 ;;
esac
