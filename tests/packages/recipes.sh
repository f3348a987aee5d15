#!/usr/bin/env bash
# recipes.sh ROOT: the recipes of other packagers, as far as a machine without their tools can tell: their files
# can be read, the options that they set exist, and the module file leads to the folder that it is installed in.
set -euo pipefail
cd "$1"
fail() { echo "recipes: $1" >&2; exit 1; }

set_names() { # those of -DNAME= and define("NAME" in the recipes
  grep -hoE -e '-D[A-Z_a-z0-9]+=' -e 'define(_from_variant)?\("[A-Z_]+"' "$@" | sed -E 's/^-D//; s/=$//; s/.*\("//; s/"$//' | sort -u
}
names=$(set_names packaging/conda/meta.yaml packaging/spack/packages/boule/package.py packaging/homebrew/boule.rb)
[[ $(wc -w <<<"$names") -ge 5 ]] || fail "found hardly any options: $names"
for name in $names; do
  [[ $name == CMAKE_* || $name == Python_EXECUTABLE ]] ||
    grep -rqw "$name" CMakeLists.txt render/apps/python/CMakeLists.txt || fail "there is no option $name"
done

python3 - packaging/spack/packages/boule/package.py <<'PYTHON' || fail "Spack's package cannot be read"
import ast, sys
ast.parse(open(sys.argv[1]).read())
PYTHON
! command -v ruby >/dev/null || ruby -c packaging/homebrew/boule.rb >/dev/null || fail "Homebrew's formula cannot be read"
sed -n '/^%post/,/^%runscript/p' packaging/apptainer/boule.def | grep -v '^%' | bash -n || fail "Apptainer's %post cannot be read"

modules=/usr/lib/$(uname -m)-linux-gnu/modulecmd.tcl
[[ -e $modules ]] || modules=/usr/share/modules/libexec/modulecmd.tcl
if [[ ! -e $modules ]]; then
  echo "recipes: without environment-modules the module file was not tried"
  exit 0
fi
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
mkdir -p "$prefix/share/modulefiles/boule" "$prefix/lib/x/pkgconfig"
cp packaging/modulefile "$prefix/share/modulefiles/boule/1.2.3"
loaded=$(MODULEPATH=$prefix/share/modulefiles tclsh "$modules" sh load boule)
for part in "PATH=$prefix/bin:" "PKG_CONFIG_PATH=$prefix/lib/x/pkgconfig" "CMAKE_PREFIX_PATH=$prefix"; do
  grep -qF "$part" <<<"$loaded" || fail "the module does not set $part: $loaded"
done
