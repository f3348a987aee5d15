#!/usr/bin/env bash
# commits.sh ROOT: every commit that a document names is in the history: a number of 7 to 40 digits to the base
# 16, letters among them, outside of blocks. Exit code 77: there is no history here.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
source "$here/pages.sh"
cd "$1"
[[ "$(git rev-parse --is-shallow-repository 2>/dev/null)" == false ]] ||
  { echo "skipped: no git history here to look for commits"; exit 77; }
wrong=0 checked=0
while read -r where commit; do
  checked=$((checked + 1))
  git merge-base --is-ancestor "$commit" HEAD 2>/dev/null && continue
  echo "$where: the history has no commit $commit"
  wrong=1
done < <(pages . | xargs -r awk '
  FNR == 1 { fenced = 0 }
  /^ *```/ { fenced = !fenced }
  fenced { next }
  {
    line = $0
    while (match(line, /[0-9A-Za-z_]+/)) {
      word = substr(line, RSTART, RLENGTH)
      line = substr(line, RSTART + RLENGTH)
      if (word ~ /^[0-9a-f]+$/ && word ~ /[a-f]/ && word ~ /[0-9]/ && length(word) >= 7 && length(word) <= 40)
        print FILENAME ":" FNR, word
    }
  }')
((wrong == 0)) || exit 1
echo "$checked commits are in the history"
