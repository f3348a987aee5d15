#!/usr/bin/env bash
# Proves that sizes.sh bites: one line too many in a file or a function is refused, whatever the
# function looks like, and what is no function may be as long as a file.
set -euo pipefail
shopt -s lastpipe  # expect() counts in this shell
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{core,simd,render,scenes,tests,bench}
failures=0

# lines COUNT: statements, a line each, with what must not be mistaken for a brace.
lines() {
  local i
  for ((i = 1; i < $1; ++i)); do echo "  x += '{' + 1'000; y = \"{\\\"{\";  // {"; done
  echo '  /* { */ z = R"x({)" { )x";'
}

# expect COUNT_OR_passes: of the file on standard input, a complaint with these words, or none.
expect() {
  cat >"$work/core/a.cpp"
  if "$here/sizes.sh" "$work" >"$work/out" 2>&1; then
    [[ "$1" == passes ]] && return
    echo "NOT REFUSED: $1"
  else
    [[ "$1" != passes ]] && grep -qF "$1" "$work/out" && return
    echo "EXPECTED: $1"
    cat "$work/out"
  fi
  sed -n 1,3p "$work/core/a.cpp"
  failures=$((failures + 1))
}

# function HEAD [TAIL]: refused with 50 lines between its braces, accepted with 49.
function_of() {
  { echo "$1"; lines 50; echo "}${2:-}"; } | expect 'a function of 51 lines'
  { echo "$1"; lines 49; echo "}${2:-}"; } | expect passes
}

function_of 'void f() {'
function_of 'int f(int x = 3) const {'
function_of 'auto f() -> std::vector<int> {'
function_of 'template <class T, class = std::enable_if_t<true>>
T f(T x) noexcept {'
function_of 'bool operator==(const A& a, const B& b) {'
function_of 'A::A(int x) : x_(x), y_{x}, z_{{1, 2}} {'
function_of 'const auto f = [](int x) {' ';'
function_of 'TEST(Suite, Name) {'
function_of 'namespace a {
namespace {
#define BEGIN {
extern "C" {
struct A : B<int> {
  int x[2] = {1, 2};
  void f() const override {' $' }};\n}}}'
function_of 'std::vector<int> f(
    const std::string& text) {'

{ echo 'namespace a {'; lines 300; echo '}'; } | expect passes
{ echo 'struct A final : public B {'; lines 300; echo '};'; } | expect passes
{ echo 'enum class A : int {'; lines 300; echo '};'; } | expect passes
{ echo 'const Row rows[] = {'; lines 300; echo '};'; } | expect passes
{ echo 'const std::array<Row, 3> rows{{'; lines 300; echo '}};'; } | expect passes
seq -f '// %g' 400 | expect passes
seq -f '// %g' 401 | expect 'longer than 400 lines'
{ echo 'void f() {'; lines 3; } | expect 'braces that are not understood'

((failures == 0)) || { echo "$failures faults slipped through"; exit 1; }
echo "every limit bites"
