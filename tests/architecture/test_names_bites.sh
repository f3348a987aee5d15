#!/usr/bin/env bash
# Proves that test_names.sh bites: a name of eight words is refused, one of seven is not, whatever
# macro or language it is in.
set -euo pipefail
shopt -s lastpipe  # expect() counts in this shell
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/tests/"{core,render/apps/cli}
failures=0

# expect COMPLAINT_OR_passes FILE: the test on standard input, in that file alone.
expect() {
  rm -f "$work"/tests/core/* "$work"/tests/render/apps/cli/*
  echo 'TEST(A, B) {}' >"$work/tests/core/z_test.cpp"
  cat >"$work/tests/$2"
  if "$here/test_names.sh" "$work" >"$work/out" 2>&1; then
    [[ "$1" == passes ]] && return
    echo "NOT REFUSED: $1"
  else
    [[ "$1" != passes ]] && grep -qF "$1" "$work/out" && return
    echo "EXPECTED: $1"
    cat "$work/out"
  fi
  cat "$work/tests/$2"
  failures=$((failures + 1))
}

for macro in TEST TEST_F TEST_P TYPED_TEST RC_GTEST_PROP; do
  echo "$macro(Suite, NearestHitIsLowestIdAtEqual) {}" | expect passes core/a_test.cpp
  echo "$macro(Suite, NearestHitIsLowestIdAtEqualT) {" |
    expect 'core/a_test.cpp:1: NearestHitIsLowestIdAtEqualT has 8 words' core/a_test.cpp
done
printf 'TEST_P(Suite,\n       NearestHitIsLowestIdAtEqualT) {\n' |
  expect 'core/a_test.cpp:2: NearestHitIsLowestIdAtEqualT has 8 words' core/a_test.cpp
printf 'TEST(Suite,\n     Name) {}\nTEST(Suite, NearestHitIsLowestIdAtEqualT) {\n' | expect '8 words' core/a.h
echo 'TEST(Suite, OneTwoThreeFourFiveAovs31Bits) {}' | expect passes core/a_test.cpp
echo 'TEST(Suite, AThingOfAKindIsX) {}' | expect passes core/a_test.cpp
echo 'TEST(Suite, ASixAThingOfAKindIs) {}' | expect '8 words' core/a_test.cpp
echo 'def test_one_two_three_four_five_six_seven(x):' | expect passes core/test_a.py
echo 'def test_one_two_three_four_five_six_seven_eight():' | expect '8 words' core/test_a.py

((failures == 0)) || { echo "$failures faults slipped through"; exit 1; }
echo "the limit bites"
