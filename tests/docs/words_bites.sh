#!/usr/bin/env bash
# words_bites.sh: proves that words.sh bites, on pages with one fault each.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0
mkdir -p "$work/docs/howto"

# expect RESULT TEXT [WORDS] [PAGE]: the page with this text passes, or fails with these words.
expect() {
  local result=fails page="$work/docs/${4:-page}.md"
  printf '# What nobody says\n\n%s\n' "$2" >"$page"
  "$here/words.sh" "$work" >"$work/out" 2>&1 && result=passes
  rm "$page"
  if [[ "$result" != "$1" ]] || ! grep -qF -- "${3:-}" "$work/out"; then
    echo "$result, not $1 ${3:-}: ${2:0:200}"
    cat "$work/out"
    failures=$((failures + 1))
  fi
}

# times N TEXT: it, N times.
times() {
  local i
  for ((i = 0; i < $1; ++i)); do printf '%s ' "$2"; done
}

expect passes 'A page of few words.'
expect fails '' 'no words in'
# Headless clauses: two in 1000 words, however few there are.
expect passes 'It says what it does, and tells what it needs.'
expect fails 'It says what it does, tells what it needs, and does whatever it can.' '3 times what or who'
expect fails 'It is for people. Who reads it, who writes it, and who pays read twice.' '3 times what or who'
expect fails "$(times 3 'It says what it does.')$(times 300 'You have it.')" '3 times what or who'
expect passes "$(times 3 'It says what it does.')$(times 500 'You have it.')"
expect passes "$(times 9 'A reader who reads it, and the one who wrote it, know.')"
expect passes "$(times 9 'It does what?') What if it fails? Who knows?"
# No, none, nothing, nobody.
expect passes 'There is no page, no sentence and no word.'
expect fails 'There is no page, none is read, nobody reads, and nothing happens.' '4 times no, none'
# Sentences, and items of lists, that open so.
expect passes "$(times 3 'So it is.')"
expect fails "$(times 4 'So it is.')" '4 of 4 sentences'
expect fails $'So:\n\n- where it is,\n- **So** it is,\n1. Else' '4 of 4 sentences'
expect fails "$(times 4 'Where it is, it is.')$(times 100 'It is.')" '4 of 104 sentences'
expect passes "$(times 4 'Where it is, it is.')$(times 140 'It is.')"
# You, in pages that say how to do something.
expect fails 'Do it.' '0 times you' howto/page
expect passes 'You do it.' '' howto/page
expect fails "Your page: $(times 300 'it is')" '1 times you' howto/other
# What is no prose.
many="$(times 9 'what nobody')"
expect passes "Words: \`$many\`, [a link]($many) and ![a picture]($many)."
expect passes $'Words: `code and\n'"$many"$'`, [a\nlink]('"$many)."
expect passes $'Words:\n\n| '"$many"$' |\n|---|\n\n## '"$many"
expect passes $'Words:\n\n```text\n'"$many"$'\n```'
expect passes $'Words:\n\n- an item\n\n  ```text\n  '"$many"$'\n  ```'
expect passes $'Words: <!-- '"$many"$'\n'"$many"$' -->\n'
expect fails $'Words:\n\n```text\ncode\n```\n'"$many" '9 times what'
# A page that is exempt fails where it need not be.
printf 'It is so.\n' >"$work/CHANGELOG.md"
expect fails 'A page.' 'CHANGELOG.md passes'
times 9 'It is what it was.' >"$work/CHANGELOG.md"
expect passes 'A page.'
((failures == 0)) || exit 1
echo "every rule bites"
