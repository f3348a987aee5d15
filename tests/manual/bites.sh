#!/usr/bin/env bash
# bites.sh PROGRAM FOLDER SOURCE MANUAL LOWDOWN VERSION: proves that pages.sh and completions.sh bite, on
# copies of the folder with one fault each.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
program="$1" folder="$2" source="$3" made_by=("$4" "$5" "$6")
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

# expect WORDS SCRIPT FILE SED ARGUMENT...: with that change of the file, the script fails with these words.
expect() {
  rm -rf "$work/folder"
  cp -r "$folder" "$work/folder"
  sed -i "$4" "$work/folder/$3"
  if "$here/$2" "$program" "$work/folder" "${@:5}" >"$work/out" 2>&1 || ! grep -qF -- "$1" "$work/out"; then
    echo "$2 does not say '$1':"
    head -n 5 "$work/out"
    failures=$((failures + 1))
  fi
}

faults='/^\\fB\\-\\-seed/{N;d}' lost='s/aperture/nothing/g'
if [[ -f "$folder/boule.1" ]]; then
  expect 'its options are not those of the help' pages.sh boule-render.1 "$faults" "$source" "${made_by[@]}"
  expect 'boule-scene(5) lacks: aperture' pages.sh boule-scene.5 "$lost" "$source" "${made_by[@]}"
else
  echo "pages.sh is not tried: there are no manual pages"
fi
expect 'expected fast' completions.sh boule.bash 's/fast robust reference/fast reference/' bash
((failures == 0)) || exit 1
echo "every rule bites"
