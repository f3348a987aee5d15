#!/usr/bin/env bash
# program.sh PREFIX SCENE: the installed program renders, with the image module installed beside it.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
prefix="$1" scene="$2"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

module="$(find "$prefix" -name boule_image_io.so -path '*/lib*/boule/*' -not -path '*-packages/*')"
"$here/module_used.sh" "$module" \
  "$prefix/bin/boule" render "$scene" -o "$work/picture.jpg" --size 32x18 -q
[[ -s "$work/picture.jpg" ]] || { echo "no picture"; exit 1; }
