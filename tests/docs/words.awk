# words.awk PAGE...: a line "PAGE WORDS SENTENCES HEADLESS NONE YOU OPENERS" for each page: counts of its prose.
#
# Prose is what is left without blocks of code, tables, headings, pictures, HTML and the targets of links.
# `code` counts as one word. A paragraph or an item of a list ends a sentence, as do . ! and ?
# HEADLESS: what, whatever, whoever; who at the beginning of a clause, or after a word that is no noun. A question
# may have them.
# NONE: no, none, nothing, nobody. YOU: you, your, yours, yourself.
# OPENERS: sentences that open with what, whatever, who, whoever, where, so or else.

function page_ends() {
  paragraph_ends()
  if (page != "") print page, words, sentences, headless, none, you, openers
  words = sentences = headless = none = you = openers = 0
  fenced = comment = 0
}

# One sentence, without its mark.
function count_sentence(sentence, question,    token, count, i, word, before, opener) {
  count = split(tolower(sentence), token, /[^a-z0-9_'%^.,;:()-]+/)
  before = "("
  opener = ""
  for (i = 1; i <= count; ++i) {
    word = token[i]
    gsub(/^[^a-z0-9]+|[^a-z0-9]+$/, "", word)
    if (word == "") continue
    ++words
    if (opener == "") {
      opener = word
      ++sentences
      if (!question && word ~ /^(what|whatever|who|whoever|where|so|else)$/) {
        ++openers
        if (verbose) print "  opens: " sentence > "/dev/stderr"
      }
    }
    if (word ~ /^(no|none|nothing|nobody)$/) {
      ++none
      if (verbose) print "  none: " sentence > "/dev/stderr"
    }
    if (word ~ /^(you|your|yours|yourself|you'(re|ll|ve|d))$/) ++you
    if (!question && (word ~ /^(what|whatever|whoever|what's)$/ || (word == "who" && before ~ headless_after))) {
      ++headless
      if (verbose) print "  headless: " sentence > "/dev/stderr"
    }
    before = token[i]
  }
}

function paragraph_ends(    rest, sentence, mark) {
  gsub(/!\[[^]]*\]\([^)]*\)/, "", text)
  gsub(/``[^`]*``|`[^`]*`/, "code", text)
  gsub(/\]\([^)]*\)/, "", text)
  gsub(/<?https?:[^ >)]*>?/, "", text)
  gsub(/\*\*|\[|\]/, "", text)
  rest = text
  text = ""
  while (match(rest, /[.!?]+["')*_]*([ ]|$)/)) {
    sentence = substr(rest, 1, RSTART - 1)
    mark = substr(rest, RSTART, 1)
    rest = substr(rest, RSTART + RLENGTH)
    count_sentence(sentence, mark == "?")
  }
  count_sentence(rest, 0)
}

BEGIN {
  # Ends of clauses, and words that are no nouns.
  headless_after = "[.,;:(]$|^(and|or|but|for|of|to|by|from|with|in|on|as|than|that|if|when|where|is|are|says|say|tells|tell|asks|knows|know)$"
}
FNR == 1 { page_ends(); page = FILENAME }
/^ *```/ { paragraph_ends(); fenced = !fenced; next }
fenced { next }
{ gsub(/<!--.*-->/, "") }
comment && /-->/ { comment = 0; sub(/.*-->/, "") }
comment { next }
/<!--/ { comment = 1; sub(/<!--.*/, "") }
/^ *$/ { paragraph_ends(); next }
/^ *(\||#|<)/ || /^    / && text == "" { paragraph_ends(); next }
/^ *([-*+]|[0-9]+[.)]) / { paragraph_ends(); sub(/^ *([-*+]|[0-9]+[.)]) /, "") }
{ text = text " " $0 }
END { page_ends() }
