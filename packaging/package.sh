#!/usr/bin/env bash
# package.sh FOLDER: what is committed, as a source tarball and as Debian packages in this folder, and
# what lintian says of them. The tarball has the same bytes wherever it is made.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=$1
version=$(sed -n 's/^project(boule VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
[[ -n "$version" ]] || { echo "package: CMakeLists.txt names no version" >&2; exit 1; }
git rev-parse -q --verify HEAD >/dev/null || { echo "package: this is no clone" >&2; exit 1; }
[[ -z "$(git status --porcelain)" ]] || echo "package: what is not committed is left out" >&2

rm -rf "$folder"
mkdir -p "$folder"
tarball=$folder/boule-$version.tar.gz
git archive --format=tar --prefix="boule-$version/" HEAD | gzip -9n >"$tarball"
tar -C "$folder" -xzf "$tarball"

# Debian's folder, whose changelog has the version and the date of the commit.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
cp -r packaging/debian "$folder/boule-$version/debian"
cat >"$folder/boule-$version/debian/changelog" <<TEXT
boule ($version) unstable; urgency=medium

  * Version $version: /usr/share/doc/boule/changelog.gz says what changed.

 -- $(sed -n 's/^Maintainer: //p' packaging/debian/control)  $(date -u -R -d "@$SOURCE_DATE_EPOCH")
TEXT
(
  cd "$folder/boule-$version"
  DEB_BUILD_OPTIONS="${DEB_BUILD_OPTIONS:-parallel=$(nproc)}" dpkg-buildpackage -b -us -uc
)
echo "package: lintian says"
lintian --allow-root --fail-on error "$folder"/boule_*.changes
ls "$folder"/*.deb "$tarball"
