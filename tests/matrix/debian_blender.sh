#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# debian_blender.sh SUITE FOLDER MIRROR: a private Debian with the Blender of that suite and what the tests need.
#   trixie -> Blender 4.3, Python 3.13      sid -> Blender 5.2, Python 3.14 (a moving suite)
# Needs root and debootstrap; does nothing when all is there. Nothing stays mounted: rm -rf FOLDER removes it.
set -euo pipefail
suite=$1 folder=$2 mirror=$3
packages=(blender python3-numpy python3-scipy python3-pytest python3-requests python3-cattr
  libgl1 libegl1 libgl1-mesa-dri libglx-mesa0 libegl-mesa0 imagemagick xdotool)
stamp=$folder/.medial_axis_packages
[[ -f $stamp && $(<"$stamp") == "${packages[*]}" ]] && exit 0
# What is mounted below is seen by this script alone.
[[ ${MEDIAL_AXIS_UNSHARED:-} ]] || MEDIAL_AXIS_UNSHARED=1 exec unshare --mount -- "$0" "$@"

export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin
if [[ ! -x $folder/usr/bin/apt-get ]]; then
  debootstrap --variant=minbase --keyring=/usr/share/keyrings/debian-archive-keyring.gpg "$suite" "$folder" "$mirror"
  printf '#!/bin/sh\nexit 101\n' >"$folder/usr/sbin/policy-rc.d" # no services
  chmod +x "$folder/usr/sbin/policy-rc.d"
  ln -sf /proc/self/mounts "$folder/etc/mtab"
fi
cp -L /etc/resolv.conf /etc/hosts "$folder/etc/"
mount -t proc proc "$folder/proc"
# A mirror of a moving suite may stand still.
chroot "$folder" apt-get -o Acquire::Check-Valid-Until=false -q update
chroot "$folder" apt-get install -y -q --no-install-recommends "${packages[@]}"
chroot "$folder" apt-get clean
echo "${packages[*]}" >"$stamp"
