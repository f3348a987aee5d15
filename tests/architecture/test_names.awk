# Names of tests of at most seven words: a name says what holds, and a list of names is read at a
# glance. Reads C++ and Python files by their path from the root; prints "PATH:LINE: what is wrong".
# A capital letter begins a word, and so does an underscore in Python; AOV and T are a word each, and
# digits belong to the word before them.

BEGIN {
  limit = 7
}

function words_of(name,    count) {
  gsub(/[A-Z]+/, "_&", name)                             # OfAVec -> _Of_AVec
  while (match(name, /[A-Z][A-Z][a-z]/))                 # the last capital begins its own word
    name = substr(name, 1, RSTART) "_" substr(name, RSTART + 1)
  gsub(/[0-9]+/, "", name)
  gsub(/_+/, "_", name)
  sub(/^_/, "", name)
  sub(/_$/, "", name)
  return split(name, count, "_")
}

function judge(name,    words) {
  ++tests
  words = words_of(name)
  if (words > limit) {
    print FILENAME ":" FNR ": " name " has " words " words, more than " limit
    wrong = 1
  }
}

# The macro, its suite and its name; the name may be in the next line.
FILENAME ~ /\.(h|cpp)$/ && (unfinished != "" || /^ *(TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP)\(/) {
  line = unfinished $0
  unfinished = ""
  if (match(line, /\( *[A-Za-z0-9_]+, *[A-Za-z0-9_]+/)) {
    line = substr(line, RSTART, RLENGTH)
    sub(/.*, */, "", line)
    judge(line)
  } else if (line ~ /\([^)]*$/) {
    unfinished = line " "
  }
}

FILENAME ~ /\.py$/ && /^ *(async )?def test_/ {
  match($0, /test_[A-Za-z0-9_]+/)
  judge(substr($0, RSTART + 5, RLENGTH - 5))
}

END {
  if (!tests) {
    print "no tests"
    wrong = 1
  }
  if (!wrong) print tests " names of tests have at most " limit " words"
  exit wrong
}
