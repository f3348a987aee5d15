#!/usr/bin/env bash
# install.sh CMAKE BUILD SOURCE PREFIX: an installation holds what it should and can be moved: it is
# installed elsewhere first.
set -euo pipefail
cmake="$1" build="$2" source="$3" prefix="$4"

rm -rf "$prefix" "$prefix-before"
"$cmake" --install "$build" --prefix "$prefix-before" >/dev/null
mv "$prefix-before" "$prefix"
cd "$prefix"

lib="$(dirname "$(find . -name libboule_files.a)")"
for file in bin/boule "$lib"/libboule_{core,simd,engine,files}.a "$lib/boule/boule_image_io.so" \
  "$lib"/cmake/boule/boule-config{,-version}.cmake "$lib"/pkgconfig/boule{,-static}.pc "$lib/libboule.so" \
  include/boule/boule.h share/doc/boule/{README.md,CHANGELOG.md,LICENSE,docs/library.md,examples/example.cpp} \
  include/boule/{core/scene/scene.h,simd/dispatch/dispatch.h,render/renderer/renderer.h}; do
  [[ -f "$file" ]] || { echo "$file is not installed"; exit 1; }
done
# The Python package, where it was built: it finds what writes pictures beside itself.
if compgen -G "$build/boule/_core*.so" >/dev/null; then
  for file in __init__.py __init__.pyi py.typed boule_image_io.so; do
    [[ -f "$lib/python3/dist-packages/boule/$file" ]] || { echo "boule/$file is not installed"; exit 1; }
  done
fi
if find include | grep -E '/(kernel|lanes|cli|shading|threads)(/|$)' ||
  find include | grep -E '/(image_module|module_loader|wavefront|split|cpu)\.h$'; then
  echo "headers that are nobody's business outside"
  exit 1
fi
if grep -rnF -e "$source" -e "$build" -e "$prefix" include "$lib/cmake" "$lib/pkgconfig" share; then
  echo "paths of the machine it was built on"
  exit 1
fi
for word in boule_flags -Wall ffp-contract; do
  if grep -rn -e "$word" "$lib/cmake"; then
    echo "flags that are ours alone"
    exit 1
  fi
done
# The scenes are all there: with their data, what made it, and particle files, as they are here.
for file in "$source"/scenes/*.{toml,npy,exr,lens,xyz,csv,py,ipynb,cpp,h} "$source/scenes/README.md"; do
  cmp "$file" "share/boule/scenes/${file##*/}" || exit 1
done
# So is the manual, and what its pages lead to.
bash "$source/tests/docs/links.sh" share/doc/boule installed
echo "installed: $(find . -type f | wc -l) files"
