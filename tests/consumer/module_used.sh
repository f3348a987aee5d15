#!/usr/bin/env bash
# module_used.sh EXPECTED COMMAND...: the command loads the image module at this very path.
set -euo pipefail
expected="$1"
shift
log="$(mktemp -d)"
trap 'rm -rf "$log"' EXIT

LD_DEBUG=files LD_DEBUG_OUTPUT="$log/loader" "$@"
used="$(sed -n 's/.*calling init: \(.*boule_image_io\.so\)$/\1/p' "$log"/loader.*)"
[[ "$used" == "$expected" ]] ||
  { echo "loaded '$used', expected '$expected'" >&2; exit 1; }
