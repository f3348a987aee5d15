#!/usr/bin/env bash
# pkg_config.sh CXX flags=FLAGS PREFIX: the installed example is compiled by what pkg-config says of
# the installation, wherever that lies, static and shared, and nothing else; its hits are exact, its
# picture is there.
# Exit code 77: no pkg-config here.
set -euo pipefail
cxx="$1" flags="${2#flags=}" prefix="$3"
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
command -v pkg-config >/dev/null || { echo "pkg-config is missing"; exit 77; }
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

PKG_CONFIG_PATH="$(dirname "$(find "$prefix" -name boule.pc)")"
export PKG_CONFIG_PATH
expected='ray 0: primitive 0 at t = 5
ray 1: primitive 1 at t = 0.5
ray 2: primitive -1 at t = inf'

# example_works NAME MODULE: the example, compiled by what pkg-config says of NAME, loads this module.
example_works() {
  local options libraries said
  pkg-config --validate "$1"
  read -ra options <<<"$flags $(pkg-config --cflags "$1")"
  read -ra libraries <<<"$(pkg-config --libs "$1")"
  rm -f example.jpg
  "$cxx" -std=c++20 "${options[@]}" "$prefix/share/doc/boule/examples/example.cpp" -o example \
    "${libraries[@]}"
  said="$("$here/module_used.sh" "$2" ./example)"
  [[ "$said" == "$expected" ]] || { printf 'said\n%s\nexpected\n%s\n' "$said" "$expected"; exit 1; }
  [[ "$(head -c 3 example.jpg | od -An -tx1)" == ' ff d8 ff' ]] ||
    { echo "example.jpg is no picture"; exit 1; }
}

cp "$(pkg-config --variable=image_module boule-static)" .
example_works boule-static "$work/boule_image_io.so"
# Installed where systems do not look, a shared library is found by what a user would set.
lib="$(dirname "$PKG_CONFIG_PATH")"
export LD_LIBRARY_PATH="$lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
example_works boule "$lib/boule/boule_image_io.so"
