#!/usr/bin/env bash
# links_bites.sh: proves that links.sh bites, on documents with one fault each.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0
mkdir -p "$work/docs" "$work/core" "$work/build/docs"
mkdir "$work/tests"
echo 'int x;' >"$work/core/a.cpp"
printf 'TEST(Suite,\n     Name) {}\nTEST_P(Other, One) {}\n' >"$work/tests/a_test.cpp"
printf '# One page\n\n## `[[key]]`: a *word*\n\n## Twice\n\n## Twice\n' >"$work/docs/other.md"
echo '[nobody looks here](nothing.md)' >"$work/build/docs/copy.md"

# expect RESULT TEXT [WORDS]: the page with this text passes, or fails with these words.
expect() {
  local result=fails
  printf '# Title\n\n%s\n' "$2" >"$work/docs/page.md"
  "$here/links.sh" "$work" >"$work/out" 2>&1 && result=passes
  if [[ "$result" != "$1" ]] || ! grep -qF -- "${3:-}" "$work/out"; then
    echo "$result: $2"
    cat "$work/out"
    failures=$((failures + 1))
  fi
}

expect passes '[a](other.md) and ![b](../core/a.cpp), `core/a.cpp`, `core/*.cpp`, `core/`'
expect passes '[a](#title) [b](other.md#one-page) [c](other.md#key-a-word) [d](other.md#twice-1)'
expect passes $'[a](other.md)\n```sh\n[no](link.md) `core/none.cpp`\n```'
expect passes '[a](other.md), `[no](link.md)` and [b](https://example.org/none.md)'
expect fails '[a](none.md)' 'docs/page.md:3: none.md leads nowhere'
expect fails '[a](other.md) [b](none.md)' 'none.md leads nowhere'
expect fails '![a](none.svg)' 'none.svg leads nowhere'
expect fails '[a](#none)' 'docs/page.md has no heading for #none'
expect fails '[a](other.md#twice-2)' 'docs/other.md has no heading for #twice-2'
expect fails '[a](other.md) `core/none.cpp`' 'docs/page.md:3: there is no core/none.cpp'
expect fails '[a](other.md) `core/*.h`' 'there is no core/*.h'
expect passes '[a](other.md) `Suite.Name`, `Other.*`, `Scene` and `Scene.toml`'
expect fails '[a](other.md) `Suite.One`' 'docs/page.md:3: there is no test Suite.One'
expect fails '[a](other.md) `None.*`' 'there is no test None.*'
rm -r "$work/docs"
if "$here/links.sh" "$work" >/dev/null 2>&1; then
  echo "a tree without documents passes"
  failures=$((failures + 1))
fi
((failures == 0)) || exit 1
echo "every rule bites"
