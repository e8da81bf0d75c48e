#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Runs a command as root of a Debian with nothing installed, in its folder /root.
# usage, as root: tests/debian/in_bare_debian.sh FOLDER SUITE COMMAND [ARGUMENT ...]
# The system is FOLDER/SUITE, made with debootstrap if it is not there; what it mounts goes when the command ends.
set -euo pipefail

if [ $# -lt 3 ] || [ "$(id -u)" -ne 0 ]; then
  echo "usage, as root: tests/debian/in_bare_debian.sh FOLDER SUITE COMMAND [ARGUMENT ...]" >&2
  exit 2
fi
system=$1/$2
suite=$2
shift 2

if [ ! -e "$system/complete" ]; then
  command -v debootstrap >/dev/null || { apt-get update -qq && apt-get install -y -qq debootstrap; } >&2
  release=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
  # shellcheck disable=SC2016 # apt-get expands it
  mirror=$(apt-get indextargets --format '$(SITE)' "Codename: $release" | head -1)
  script=/usr/share/debootstrap/scripts/$suite
  [ -e "$script" ] || script=/usr/share/debootstrap/scripts/sid # of a release that is newer than debootstrap
  rm -rf --one-file-system "$system"
  debootstrap --variant=minbase "$suite" "$system" "$mirror" "$script" >&2
  touch "$system/complete"
fi
for name in /etc/resolv.conf /etc/hosts; do cp "$name" "$system$name"; done
cp -r /etc/apt/apt.conf.d/. "$system/etc/apt/apt.conf.d/" # a proxy, where there is one

leave() { for name in dev sys proc; do umount -l "$system/$name" 2>/dev/null || true; done; }
trap leave EXIT
mount -t proc proc "$system/proc"
for name in sys dev; do
  mount --rbind "/$name" "$system/$name"
  mount --make-rslave "$system/$name"
done
chroot "$system" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive \
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
  sh -c 'cd /root && exec "$@"' sh "$@" </dev/null
