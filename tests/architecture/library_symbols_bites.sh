#!/usr/bin/env bash
# library_symbols_bites.sh CXX: proves that library_symbols.sh bites, on archives with one fault.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cxx="$1"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
failures=0

# check BODY: library_symbols.sh on an archive of two objects, one with a function of this body.
check() {
  rm -f "$work"/*.o "$work/all.a"
  printf '%s\n' '#include <cassert>' '#include <csignal>' '#include <cstdio>' '#include <cstdlib>' \
    '#include <fstream>' '#include <iostream>' '#include <unistd.h>' "void f(int i) { $1; }" \
    >"$work/culprit.cpp"
  grep -q cout <<<"$1" || sed -i '/<iostream>/d' "$work/culprit.cpp"
  echo 'void g(); void h() { g(); }' >"$work/bystander.cpp"
  for name in culprit bystander; do
    "$cxx" -std=c++20 -O2 -c "$work/$name.cpp" -o "$work/$name.o" || exit 1
  done
  ar rc "$work/all.a" "$work/bystander.o" "$work/culprit.o"
  "$here/library_symbols.sh" "$work/all.a" >"$work/out" 2>&1
}

for body in 'std::abort()' 'std::exit(i)' '_exit(i)' 'std::quick_exit(i)' 'assert(i > 0)' \
  'std::raise(i)' 'kill(i, i)' 'std::puts("no")' 'std::printf("%d", i)' 'std::putchar(i)' \
  'std::fprintf(stderr, "%d", i)' 'std::fputs("no", stdout)' 'dprintf(2, "%d", i)' \
  'std::perror("no")' 'std::cout << i'; do
  if check "$body"; then
    echo "NOT REFUSED: $body"
    failures=$((failures + 1))
  elif ! grep -q '^culprit\.o: ' "$work/out"; then
    echo "WRONG WORDS: $body"
    cat "$work/out"
    failures=$((failures + 1))
  fi
done
for body in 'char b[9]; std::snprintf(b, 9, "%d", i); if (b[0] != 48) throw i' \
  'std::ofstream("x") << i' 'if (write(i, "no", 2) != 2) throw i'; do
  check "$body" || { echo "REFUSED: $body"; cat "$work/out"; failures=$((failures + 1)); }
done
"$here/library_symbols.sh" /dev/null >/dev/null 2>&1 && { echo "NOT REFUSED: nothing"; failures=1; }

((failures == 0)) || { echo "$failures faults slipped through"; exit 1; }
echo "every symbol bites"
