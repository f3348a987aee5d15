#!/usr/bin/env bash
# administrator.sh BOOTSTRAP: runs bootstrap.sh as a user without rights, where packages are missing.
# Without sudo it prints a line for an administrator that installs them, and does nothing else; with
# sudo it uses that. Exit code 77: there is no way to run as such a user.
set -euo pipefail

readonly bootstrap=$1
as_nobody=()
if ((EUID == 0)); then
  command -v setpriv >/dev/null || { echo "no setpriv: root stays root"; exit 77; }
  as_nobody=("$(command -v setpriv)" --reuid=65534 --regid=65534 --clear-groups)
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
readonly folder
mkdir "$folder/tools" "$folder/calls"
cp "$bootstrap" "$folder/bootstrap.sh"
chmod 755 "$folder" "$folder/bootstrap.sh"
chmod 777 "$folder/calls"
for tool in bash dirname env cat nproc; do ln -s "$(command -v "$tool")" "$folder/tools/$tool"; done

# add_tool NAME LINE...: a program that does as the lines say.
add_tool() {
  local name=$1
  shift
  printf '%s\n' '#!/usr/bin/env bash' "$@" >"$folder/tools/$name"
  chmod 755 "$folder/tools/$name"
}
add_tool dpkg-query '[[ "${!#}" != *clang* ]] || echo installed; exit 0'
add_tool apt-get "echo \"apt-get \$*\" >>'$folder/calls/log'"
add_tool cmake 'exit 3' # behind the installation there is nothing to see here

# run COMMAND: bootstrap.sh as nobody, with these tools only; its exit status.
run() {
  local status=0
  : >"$folder/calls/log"
  chmod 666 "$folder/calls/log"
  "${as_nobody[@]}" "$(command -v env)" -i PATH="$folder/tools" \
    "$folder/bootstrap.sh" "$1" >"$folder/out" 2>"$folder/err" || status=$?
  return "$status"
}
fail() {
  echo "$1"
  cat "$folder/out" "$folder/err"
  exit 1
}

status=0
run test || status=$?
((status == 1)) || fail "without sudo it ends with $status, not 1"
[[ ! -s "$folder/calls/log" ]] || fail "without sudo it has called apt-get"
line=$(grep '^apt-get update && apt-get install ' "$folder/err") || fail "no line to be pasted"
[[ "$(wc -l <<<"$line")" == 1 ]] || fail "more than one line to be pasted"
for package in g++ ninja-build libopenimageio-dev libgtest-dev; do
  [[ " $line " == *" $package "* ]] || fail "the line lacks $package"
done
[[ "$line" != *clang* ]] || fail "the line has what is installed already"
# Pasted into an administrator's shell the line calls apt-get with these very packages.
PATH="$folder/tools" bash -c "$line"
[[ "$(cat "$folder/calls/log")" == "apt-get update"$'\n'"${line#*&& }" ]] || fail "pasted, the line is another one"

add_tool sudo "echo sudo >>'$folder/calls/log'" 'exec "$@"'
status=0
run render || status=$?
((status == 3)) || fail "with sudo it ends with $status, not with cmake's 3"
grep -q '^sudo$' "$folder/calls/log" || fail "sudo is there and has not been used"
grep -q '^apt-get install .*g++' "$folder/calls/log" || fail "nothing was installed"
grep -q '^bootstrap: compiles the program .*; about [0-9]* minutes here' "$folder/out" || fail "it does not say what it will do"

rm "$folder/tools/apt-get"
status=0
run render || status=$?
((status == 1)) || fail "without apt-get it ends with $status, not 1"
grep -q 'no apt-get here; .* g++ ' "$folder/err" || fail "without apt-get it does not say what is missing"
echo "bootstrap.sh asks who may"
