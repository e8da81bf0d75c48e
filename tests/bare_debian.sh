#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Shows that the two commands need nothing by hand: a fresh clone of HEAD in a bare Debian 12.
# usage: tests/bare_debian.sh FOLDER [COMMAND ...]   (as root; default commands: "demo" "test")
# SUITE=trixie takes a Debian 13 instead.
set -euo pipefail

if [ $# -eq 0 ] || [ "$(id -u)" -ne 0 ]; then
  echo "usage, as root: tests/bare_debian.sh FOLDER [COMMAND ...]" >&2
  exit 1
fi
folder=$1
shift
[ $# -gt 0 ] || set -- demo test
repository=$(cd "$(dirname "$0")/.." && pwd)
suite=${SUITE:-bookworm}
system=$folder/$suite
# shellcheck disable=SC2016 # apt-get expands it
mirror=$(apt-get indextargets --format '$(SITE)' 'Codename: bookworm' | head -1)

if [ ! -x "$system/usr/bin/apt-get" ]; then
  command -v debootstrap >/dev/null || apt-get install -y -qq debootstrap
  debootstrap --variant=minbase "$suite" "$system" "$mirror"
fi
for name in /etc/resolv.conf /etc/hosts; do cp "$name" "$system$name"; done
cp -r /etc/apt/apt.conf.d/. "$system/etc/apt/apt.conf.d/" # a proxy, where there is one
rm -rf "$system/root/cfpm"
git clone -q "$repository" "$system/root/cfpm"

mounted() { for name in dev sys proc; do umount -l "$system/$name" 2>/dev/null || true; done; }
trap mounted EXIT
mount -t proc proc "$system/proc"
mount --rbind /sys "$system/sys"
mount --rbind /dev "$system/dev"
for command in "$@"; do
  echo "=== ./cfpm $command in a bare Debian"
  chroot "$system" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "cd /root/cfpm && ./cfpm $command" </dev/null
done
