# shellcheck shell=bash
# What the tests of the documents have in common; sourced.

# pages ROOT: the documents below a folder, from there, but for those of builds.
pages() {
  (cd "$1" && find -L . \( -type d -name 'build*' -o -name '.?*' \) -prune -o -name '*.md' -print) |
    sed 's|^\./||' | LC_ALL=C sort
}
