#!/usr/bin/env bash
# flags.sh COMPILE_COMMANDS ROOT COMPILER: every source of ours is compiled with -ffp-contract=off and
# without any option that lets the compiler change results; if COMPILER is GNU, also without the SLP
# vectoriser.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/compilations.sh"

compilations "$1" "$2" | awk -F'\t' -v root="$2/" -v compiler="$3" '
  {
    file = $1
    command = $2
    ++sources
    if (command !~ / -ffp-contract=off /) {
      print file ": compiled without -ffp-contract=off"
      wrong = 1
    }
    if (compiler == "GNU" && command !~ / -fno-tree-slp-vectorize /) {
      print file ": compiled without -fno-tree-slp-vectorize"
      wrong = 1
    }
    # The last one counts, and any other value would be a mistake.
    if (match(command, / -(ffast-math|Ofast|funsafe-math-optimizations|fassociative-math|freciprocal-math|ffinite-math-only|fno-signed-zeros|ffp-contract=(fast|on)|march=native|mfpmath=387)/)) {
      print file ": compiled with" substr(command, RSTART, RLENGTH)
      wrong = 1
    }
  }
  END {
    if (!sources) print "no sources of " root " in the compile commands"
    else if (!wrong) print sources " compilations keep to exact arithmetic"
    exit wrong || !sources
  }'
