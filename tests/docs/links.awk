# What documents refer to, and what they can be referred to by, a line each:
#   anchor PAGE SLUG           a heading, as GitHub names it
#   link PAGE:LINE TARGET      what a link or a picture points to
#   path PAGE:LINE PATH        a file of ours that is named in `code`
#   test PAGE:LINE SUITE.NAME  a test likewise; all of a suite: SUITE.*

FNR == 1 { fenced = 0 }
/^ *```/ { fenced = !fenced; next }
fenced { next }

/^#+ / {
  slug = $0
  sub(/^#+ +/, "", slug)
  slug = tolower(slug)
  gsub(/[^a-z0-9 _-]/, "", slug)
  gsub(/ /, "-", slug)
  seen = count[FILENAME, slug]++
  print "anchor", FILENAME, slug (seen ? "-" seen : "")
}

{
  text = $0
  while (match(text, /`[^`]+`/)) {
    code = substr(text, RSTART + 1, RLENGTH - 2)
    text = substr(text, 1, RSTART - 1) " " substr(text, RSTART + RLENGTH)
    if (code ~ /^(core|simd|render|tests|bench|scenes|docs)\/[A-Za-z0-9_.*\/-]+$/)
      print "path", FILENAME ":" FNR, code
    else if (code ~ /^[A-Z][A-Za-z]+\.([A-Z][A-Za-z]+|\*)$/)
      print "test", FILENAME ":" FNR, code
  }
  while (match(text, /\]\([^()]+\)/)) {
    print "link", FILENAME ":" FNR, substr(text, RSTART + 2, RLENGTH - 3)
    text = substr(text, 1, RSTART - 1) " " substr(text, RSTART + RLENGTH)
  }
}
