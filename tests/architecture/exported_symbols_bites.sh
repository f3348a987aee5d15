#!/usr/bin/env bash
# exported_symbols_bites.sh CXX CLANG CMAKE: exported_symbols.sh notices a hidden public function and a private one
# that is shown; the version script shows a class, a function, and one that returns a string.
set -euo pipefail
cxx=$1 clang=$2 cmake=$3
command -v "$clang" >/dev/null || { echo "no clang"; exit 77; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cat >api.h <<'TEXT'
#include <string>
namespace boule {
class Open {
 public:
  Open();
  int number() const;
};
int one(int a);
std::string text();
inline int two() { return one(2); }
}  // namespace boule
TEXT
cat >api.cpp <<'TEXT'
#include "api.h"
namespace boule {
Open::Open() = default;
int Open::number() const { return 1; }
int secret() { return 3; }
int one(int a) { return a + secret(); }
std::string text() { return "text"; }
}  // namespace boule
TEXT
"$cmake" -DHEADERS="$work/api.h" -DOUTPUT="$work/api.map" -P "$here/../../render/apps/library/version_script.cmake"
"$cxx" -std=c++20 -fPIC -c api.cpp -o api.o

# check MAP: the library with this version script.
check() {
  "$cxx" -shared api.o -Wl,--version-script="$1" -o libapi.so
  "$here/exported_symbols.sh" libapi.so api.h "$clang" -std=c++20 -- api.o >said 2>&1
}
status=0
check api.map || status=$?
((status == 0)) || { cat api.map said; echo "finds faults where there are none"; exit 1; }
grep -q '^4 functions are shown, 1 are hidden' said || { cat said; echo "counts otherwise"; exit 1; }

# bites SED WHAT: the version script, changed, is noticed by these words.
bites() {
  sed "$1" api.map >changed.map
  if check changed.map; then echo "does not notice: $2"; exit 1; fi
  grep -qF "$2" said || { cat said; echo "does not say: $2"; exit 1; }
}
bites 's/boule::one/boule::none/' 'boule::one(int): public, but hidden'
bites 's/boule::one.*;/boule::*;/' 'boule::secret(): shown, but no public header declares it'
bites 's/boule::text/boule::no_text/' 'boule::text[abi:cxx11](): public, but hidden'
echo "shown and hidden functions are noticed"
