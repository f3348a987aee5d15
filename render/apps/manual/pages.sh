#!/bin/sh
# pages.sh LOWDOWN FOLDER VERSION DATE: NAME.md there becomes NAME, a manual page, by the program lowdown.
#
# lowdown leaves this to be done: capitals, no hyphenation, for words are names; hyphens and quotes as one types
# them; code in bold and behind a margin; headings on the line of their macro; terms close to their meaning.
set -eu
export LC_ALL=C
for text in "$2"/*.md; do
  page="${text%.md}" name="$(basename "$text" .md)"
  "$1" -s -t man --nroff-no-groff --nroff-nolinks --out-no-smarty --parse-no-intraemph --parse-no-metadata \
    --parse-no-super -m title="${name%.*}" -m section="${name##*.}" -m date="$4" -m source="boule $3" \
    -m volume="Boule manual" -o "$page" "$text"
  sed -i -e '/^\.TH/{s/"[^"]*"/\U&/; s/$/\n.nh\n.ad l/}' -e 's/^\.nf/.RS 4\n&/; s/^\.fi/&\n.RE/; /^\.ft/d' \
    -e "/^[.]/!{s/-/\\\\-/g; s/'/\\\\(aq/g; s/\\\\f\\(C\\|(C[BRW]\\)/\\\\fB/g}" -e 's/^\.TP .*/.TP/' "$page"
  sed -i -z -e 's/\(\.S[HS]\)\n\([^\n]*\)/\1 \2/g; s/\.SH [^\n]*/\U&/g' \
    -e 's/\.LP\n\([^\n]*\)\n\.if n[^"]*\.IP "" 5n/.TP\n\1/g; s/\.if n[^"]*\.IP "" 5n/.IP/g' \
    -e 's/\(\.S[HS] [^\n]*\n\)\(\.LP\|\.if n[^"]*\.sp -0\.25v\)\n/\1/g' "$page"
done
