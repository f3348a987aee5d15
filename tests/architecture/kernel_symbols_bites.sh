#!/usr/bin/env bash
# kernel_symbols_bites.sh CXX: proves that kernel_symbols.sh bites, on tiny kernels with one fault.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cxx="$1"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

# compile NAME SOURCE: NAME.o from a few lines.
compile() {
  printf '%s\n' "$2" >"$work/$1.cpp"
  "$cxx" -std=c++20 -O2 -fPIC -fno-exceptions -c "$work/$1.cpp" -o "$work/$1.o"
}

# kernel NAME EXTRA: a kernel of that ISA, which holds the extra lines too.
kernel() {
  compile "$1" "namespace boule::$1 {
extern int (*const kernel_table)(int);
$2
namespace { int answer(int x) { return x + 1; } }
int (*const kernel_table)(int) = answer;
}"
}

# The wide one has a second object, of which the first asks a template.
compile helper 'namespace boule::wide {
template <class T> T half(T x) { return x / 2; }
template int half<int>(int);
}'
check() {
  "$here/kernel_symbols.sh" "wide=$work/wide.o,$work/helper.o" "narrow=$work/narrow.o" -- "$work/rest.o" \
    >"$work/out" 2>&1
}

# refused EXTRA WORDS: a kernel with the extra lines is refused with these words.
refused() {
  kernel wide "$1"
  if check; then
    echo "NOT REFUSED: $1"
    failures=$((failures + 1))
  elif ! grep -qF "$2" "$work/out"; then
    echo "WRONG WORDS: $1"
    cat "$work/out"
    failures=$((failures + 1))
  fi
}

shared='}
template <class T> [[gnu::noinline]] T shared(T x) { return x * x; }
template int shared<int>(int);
namespace boule::wide {'
compile rest 'template <class T> [[gnu::noinline]] T other(T x) { return x - 1; }
template int other<int>(int);'
kernel narrow ''
kernel wide 'template <class T> T half(T x);
namespace { const int table[] = {1, 2}; [[gnu::used]] int quarter(int x) { return half(half(x)); } }'
check || { echo "the faultless kernels are refused:"; cat "$work/out"; failures=1; }

refused 'int extra(int x) { return x; }' 'exports: boule::wide::'
refused 'template <class T> T third(T x); namespace { [[gnu::used]] int f(int x) { return third(x); } }' \
  'wide calls out'
refused 'int user(int x); namespace { struct S { int a = user(1); } s; }' 'wide calls out'
refused '}
extern "C" double cos(double); extern "C" double sin(double);
namespace boule::wide { namespace { [[gnu::used]] double f(double x) { return sin(cos(x)); } }' \
  'wide calls out: '
refused 'namespace { [[gnu::used]] int counter = 3; }' 'wide has constructors or variables'
refused 'namespace { [[gnu::used]] int counter; }' 'wide has constructors or variables'
refused 'namespace { struct S { S() { asm volatile(""); } } s; }' \
  'wide has constructors or variables: .init_array'

compile rest "namespace boule::wide {
$shared
}"
refused "$shared" 'wide and the rest of the program share weak symbols'
compile rest 'template <class T> [[gnu::noinline]] T other(T x) { return x - 1; }
template int other<int>(int);'
kernel narrow "}
template <class T> [[gnu::noinline]] T shared(T x) { return x * x; }
template int shared<int>(int);
namespace boule::narrow {"
refused "$shared" 'wide and narrow share weak symbols'
kernel narrow ''
compile wide 'int nothing_of_ours = 0;'
check && { echo "NOT REFUSED: an object without a table"; failures=$((failures + 1)); }

((failures == 0)) || { echo "$failures faults slipped through"; exit 1; }
echo "every rule bites"
