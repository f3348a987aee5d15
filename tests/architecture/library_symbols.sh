#!/usr/bin/env bash
# library_symbols.sh ARCHIVE|OBJECT...: nothing in the library ends the process or writes to the
# terminal, not even through a macro: no object needs a symbol that does.
# (std::terminate is not among them: compilers call it where noexcept is broken.)
set -euo pipefail
export LC_ALL=C

ends='abort|(_|quick_)?exit|_Exit|__assert(_perror)?_fail|raise|(tg)?kill|(sig|_)?longjmp|verr|errx?'
prints='v?[fd]?w?printf|__v?[fd]?w?printf_chk|f?put(s|w?c)|put(w?char|w)|fwrite(_unlocked)?|perror'
prints+='|v?syslog|v?warnx?|psignal|std(out|err)|std::w?c(out|err|log)'
prints+='|fmt::.*v?print\(.*'

wrong=0 objects=0
for file in "$@"; do
  # FILE:MEMBER: U SYMBOL@VERSION
  asked="$(nm --undefined-only -A -C "$file" 2>/dev/null | sed -E 's/@.*$//')"
  objects=$((objects + $(cut -d ' ' -f 1 <<<"$asked" | sort -u | grep -c .)))
  found="$(grep -E " [Uwv] ($ends|$prints)\$" <<<"$asked" | sed -E 's/^([^ ]*[/:])?([^/: ]+): +[Uwv] /\2: /' || true)"
  [[ -z "$found" ]] || { echo "$found"; wrong=1; }
done
((objects > 0)) || { echo "no objects given"; exit 1; }
((wrong == 0)) || { echo "the process and the terminal are the program's"; exit 1; }
echo "$objects objects neither end the process nor print"
