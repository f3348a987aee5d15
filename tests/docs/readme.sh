#!/usr/bin/env bash
# readme.sh README [ROOT]: the front page is short: 110 lines at most, and its table of figures has eight rows
# at most, each of numbers. Its figures name machine, commit and date. With the root of a clone: the commit is in
# its history, and its report wrote this table: none was changed since, and its heading is the same. Figures
# that are "committed as" one were written by an older report. Exit code 77: there is no history here.
set -euo pipefail
awk '
  /<!-- report: begin -->/ { inside = 1 }
  /<!-- report: end -->/ { ended = inside; inside = 0 }
  inside && /^\|/ { if (++lines > 2) { ++rows; if ($0 !~ /\| [0-9.]+ \|/) bad = bad $0 "\n" } }
  inside { text = text " " $0 }
  END {
    if (NR > 110) wrong = wrong NR " lines, 110 at most\n"
    if (!ended) wrong = wrong "no table between the marks of the report\n"
    if (rows > 8) wrong = wrong rows " rows of figures, 8 at most\n"
    if (bad) wrong = wrong "no figures: " bad
    if (text !~ /Measured on [^,]+, .*commit [0-9a-z]+/) wrong = wrong "no machine and commit of the figures\n"
    if (rows && text !~ / (19|20)[0-9][0-9]-[0-9][0-9]-[0-9][0-9]/) wrong = wrong "no date of the figures\n"
    printf "%s", wrong ? wrong : NR " lines, " rows + 0 " rows of figures\n"
    exit wrong != ""
  }' "$1"
[[ $# -gt 1 ]] || exit 0

cd "$2"
[[ "$(git rev-parse --is-shallow-repository 2>/dev/null)" == false ]] ||
  { echo "skipped: no git history here to look for the commit of the figures"; exit 77; }
page="$(sed -n '/report: begin/,/report: end/p' "$1" | tr '\n' ' ')"
[[ "$page" =~ commit\ ([0-9a-f]+)(\+?) ]] || { echo "the figures name no commit"; exit 1; }
commit="${BASH_REMATCH[1]}" changed="${BASH_REMATCH[2]}"
[[ -z "$changed" ]] || { echo "files were changed since the commit that was measured, $commit"; exit 1; }
git merge-base --is-ancestor "$commit" HEAD 2>/dev/null || { echo "the history has no commit $commit"; exit 1; }
[[ "$page" != *"committed as"* ]] || exit 0
heading="$(sed -n '/report: begin/,/report: end/p' "$1" | grep -m 1 '^| ' || true)"
git grep -qF -e "$heading" "$commit" -- bench/report/readme.py ||
  { echo "the report of $commit writes another table than '$heading'"; exit 1; }
