#!/usr/bin/env bash
# readme.sh README: the front page is short: 130 lines at most, and its table of figures has eight rows
# at most, each of numbers.
set -euo pipefail
awk '
  /<!-- report: begin -->/ { inside = 1 }
  /<!-- report: end -->/ { ended = inside; inside = 0 }
  inside && /^\|/ { if (++lines > 2) { ++rows; if ($0 !~ /\| [0-9.]+ \|/) bad = bad $0 "\n" } }
  END {
    if (NR > 130) wrong = wrong NR " lines, 130 at most\n"
    if (!ended) wrong = wrong "no table between the marks of the report\n"
    if (rows > 8) wrong = wrong rows " rows of figures, 8 at most\n"
    if (bad) wrong = wrong "no figures: " bad
    printf "%s", wrong ? wrong : NR " lines, " rows + 0 " rows of figures\n"
    exit wrong != ""
  }' "$1"
