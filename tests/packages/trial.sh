#!/usr/bin/env bash
# trial.sh PACKAGES CHROOT: the packages of a release in a clean root, as one who installs them meets
# them. PACKAGES is the folder that packaging/package.sh filled, CHROOT a fresh root of the same Debian:
#   debootstrap --variant=minbase bookworm CHROOT
# As root. Each package is installed there and used: the program and its manual, a program by CMake and
# one by pkg-config against the library, shared and static, Python, ranks of both MPIs. Then all are
# purged; no file of theirs may be left.
set -euo pipefail
packages=$(realpath "$1") root=$(realpath "$2")
consumer=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../consumer")
# shellcheck source=tests/packages/root.sh
source "$(dirname "${BASH_SOURCE[0]}")/root.sh"
cp /etc/resolv.conf "$root/etc/"
cp "$packages"/*.deb "$root/trial/"
cp -r "$consumer" "$root/trial/consumer"
cp "$(dirname "${BASH_SOURCE[0]}")/inside.sh" "$root/trial/"
cp -r "$(dirname "${BASH_SOURCE[0]}")/../docs" "$root/trial/docs"
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" \
  chroot "$root" bash /trial/inside.sh
