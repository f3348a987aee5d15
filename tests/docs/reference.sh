#!/usr/bin/env bash
# reference.sh cpp DOXYGEN DOXYFILE, or python PYTHON SOURCE PACKAGE: the pages of the target `reference` are made
# without a warning, have what users look for, and their search finds it. Exit code 77: no Sphinx here.
set -euo pipefail
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

case "$1" in
  cpp)
    # The folder of the sources is in the file, as what is taken off paths.
    cd "$(sed -n 's/^STRIP_FROM_PATH *= "\(.*\)"$/\1/p' "$3")"
    sed "s|^OUTPUT_DIRECTORY .*|OUTPUT_DIRECTORY = $work|" "$3" >"$work/Doxyfile"
    "$2" "$work/Doxyfile" >"$work/out" 2>&1
    index="$work/cpp/search" names=(Renderer Tracer closest load_scene write_image select_kernels RenderOptions)
    ;;
  python)
    "$2" -c 'import sphinx' 2>/dev/null || { echo "skipped: no python3-sphinx"; exit 77; }
    PYTHONPATH="$4" PYTHONDONTWRITEBYTECODE=1 "$2" -m sphinx -q -E -d "$work/doctrees" "$3" "$work/python" \
      >"$work/out" 2>&1
    index="$work/python/searchindex.js" names=(Scene add_spheres Tracer closest render from_ase Picture save Plastic)
    ;;
esac
if grep -v '^$' "$work/out"; then
  echo "warnings, above"
  exit 1
fi
for name in "${names[@]}"; do
  grep -rqw "$name" "$index" || { echo "the search does not find $name"; exit 1; }
done
echo "${#names[@]} names are found"
