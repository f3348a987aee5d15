#!/usr/bin/env bash
# words.sh ROOT [table]: the English of each page, in figures. Of 1000 words of its prose at most 2 are a "what" or
# "who" without a noun before it, and at most 3 say "no", "none", "nothing" or "nobody". Of 1000 sentences at most 30
# open with what, who, where, so or else. A page that says how to do something says "you" or "your" 8 times in 1000
# words. words.awk says what prose is and what is counted; a page of fewer than 1000 words, or 100 sentences, may
# have as many as one that has them. With "table" the figures of all pages are printed, and nothing is demanded.
set -euo pipefail
what_to_do="${2:-check}"
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
source "$here/pages.sh"
cd "$1"

# Pages with another style, and the reason. One that would pass may not stand here.
declare -A exempt=(
  [CHANGELOG.md]='history: an entry stays as it was written'
)
how_to='^(README|docs/(command_line|python|particles|cluster|view|building|library|measuring|recipes|howto/.*))\.md$'

mapfile -t documents < <(pages .)
((${#documents[@]} > 0)) || { echo "no documents in $1"; exit 1; }
counts="$(awk -f "$here/words.awk" "${documents[@]}")"
if [[ "$what_to_do" == table ]]; then
  awk '
    function show(page, words, sentences, headless, none, you, openers) {
      printf "%-28s %6d %9d %8.1f %5.1f %5.1f %8.1f\n", page, words, sentences,
        1000 * headless / words, 1000 * none / words, 1000 * you / words, 1000 * openers / sentences
    }
    BEGIN { print "page                          words sentences headless  none   you  openers" }
    $2 > 0 {
      show($1, $2, $3, $4, $5, $6, $7)
      for (i = 2; i <= 7; ++i) sum[i] += $i
    }
    END { show("all", sum[2], sum[3], sum[4], sum[5], sum[6], sum[7]) }' <<<"$counts"
  exit
fi

wrong=0 checked=0
complain() {
  echo "$1"
  wrong=1
}

# faults PAGE WORDS SENTENCES HEADLESS NONE YOU OPENERS: a line for each limit that is not kept.
faults() {
  local page="$1" words="$2" sentences="$3" headless="$4" none="$5" you="$6" openers="$7"
  local of_words=$((words > 1000 ? words : 1000)) of_sentences=$((sentences > 100 ? sentences : 100))
  ((1000 * headless <= 2 * of_words)) || echo "$page: $headless times what or who without a noun in $words words"
  ((1000 * none <= 3 * of_words)) || echo "$page: $none times no, none, nothing or nobody in $words words"
  ((1000 * openers <= 30 * of_sentences)) || echo "$page: $openers of $sentences sentences open with what, who, where, so or else"
  [[ ! "$page" =~ $how_to ]] || ((1000 * you >= 8 * words)) || echo "$page: $you times you or your in $words words"
}

while read -r page words rest; do
  read -ra rest <<<"$rest"
  found="$(faults "$page" "$words" "${rest[@]}")"
  checked=$((checked + words))
  if [[ -z "${exempt[$page]:-}" ]]; then
    [[ -z "$found" ]] || complain "$found"
  elif [[ -z "$found" ]]; then
    complain "$page passes: it need not be exempt"
  fi
done <<<"$counts"
((checked > 0)) || complain "no words in ${documents[*]}"
if ((wrong != 0)); then
  echo "the sentences: awk -v verbose=1 -f $here/words.awk PAGE"
  exit 1
fi
echo "$checked words of ${#documents[@]} documents keep to the limits"
