#!/usr/bin/env bash
# release.sh: whether what is committed can be released, in what form, and by which commands it is tagged.
# It tags and pushes nothing. docs/versions.md says what a version means.
# release.sh --check: the checks of numbers and dates alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  echo "release: $1" >&2
  exit 1
}

version=$(sed -n 's/^project(boule VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
[[ "$version" =~ ^([0-9]+\.[0-9]+)\.[0-9]+$ ]] || fail "CMakeLists.txt names no version like 1.2.3"
interface=${BASH_REMATCH[1]}
section=$(grep -m 1 '^## \[' CHANGELOG.md)
[[ "$section" =~ ^##\ \[$version\]\ -\ [0-9]{4}-[0-9]{2}-[0-9]{2}$ ]] ||
  fail "the newest section of CHANGELOG.md is '$section', not that of $version with a date"
grep -q "^Package: libboule$interface\$" packaging/debian/control ||
  fail "packaging/debian/control has no package libboule$interface"
grep -q "^version: $version\$" CITATION.cff || fail "CITATION.cff has another version than $version"
grep -q "^date-released: ${section##* }\$" CITATION.cff || fail "CITATION.cff has another date than CHANGELOG.md"
[[ "${1:-}" != --check ]] || { echo "release: $version can be released"; exit 0; }

[[ -z "$(git status --porcelain)" ]] || fail "not all is committed: git status"
[[ -z "$(git tag --list "v$version")" ]] || fail "there is a tag v$version already"
./bootstrap.sh package
tarball=build/package/boule-$version.tar.gz
git archive --format=tar --prefix="boule-$version/" HEAD | gzip -9n | cmp - "$tarball" ||
  fail "the same commit makes another tarball"
(./bootstrap.sh test) || fail "a test has failed"
./bootstrap.sh wheel
python=$(/usr/bin/python3 -c 'import sys; print("cp{}{}".format(*sys.version_info))')  # wheels of others may lie there
# As root the packages and the wheel are installed and used in roots that have nothing of Boule's.
if ((EUID == 0)) && command -v debootstrap >/dev/null; then
  root=$(mktemp -d)
  trap 'rm -rf "$root"' EXIT
  debootstrap --variant=minbase bookworm "$root/packages" >"$root/log"
  tests/packages/trial.sh build/package "$root/packages"
  debootstrap --variant=minbase --include=python3,python3-pip,python3-numpy bookworm "$root/wheel" >"$root/log"
  tests/packages/wheel_trial.sh build/wheel/boule-"$version"-"$python"-*.whl "$root/wheel"
else
  echo "release: the trials in clean roots need root and debootstrap: they were left out"
fi

echo "release: $(sha256sum "$tarball")"
echo "release: boule $version is ready. It is tagged by"
echo "  git tag -a v$version -m 'Boule $version' $(git rev-parse HEAD)"
echo "  git push origin v$version"
echo "release: then name the commit in CHANGELOG.md: '## [$version] - DATE, commit $(git rev-parse --short=12 HEAD)'"
