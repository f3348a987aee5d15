#!/usr/bin/env bash
# startup_bites.sh PROGRAM SCENE MODULE: proves that startup.sh bites: a program that is slow, has
# the wrong exit code or loads the image module must be refused.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
program="$1" scene="$2" module="$3"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# refused WORDS SCRIPT-LINE: a wrapper around the program.
refused() {
  printf '#!/usr/bin/env bash\n%s\nexec "%s" "$@"\n' "$2" "$program" >"$work/boule"
  chmod +x "$work/boule"
  if "$here/startup.sh" "$work/boule" 100 >"$work/out" 2>&1; then
    echo "NOT REFUSED: $2"
    exit 1
  fi
  grep -qF "$1" "$work/out" || { echo "WRONG WORDS: $2"; cat "$work/out"; exit 1; }
}

# Twelve ticks of the processor, ten milliseconds each.
refused 'longer than 100 ms' \
  'while read -r -a s <"/proc/$$/stat" && ((s[13] + s[14] < 12)); do :; done'
refused 'expected 0' 'exit 5'
refused 'loads OpenImageIO' "export LD_PRELOAD='$module'"
# Writing BMP loads the module, so the check for it can fail.
LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" \
  "$program" render "$scene" -o "$work/picture.bmp" --size 4x4 --spp 1 -q
grep -qhi 'OpenImageIO' "$work"/loaded.* || { echo "rendering loads no OpenImageIO"; exit 1; }
echo "every rule bites"
