#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# arm64.sh ARGUMENTS ...: Debian 12's Python for arm64, run by qemu-user on another processor; needs mmdebstrap,
# qemu-user-static and no rights. Its folder, build/blenders/bookworm-arm64 (or below $MEDIAL_AXIS_BLENDERS), is made
# when it is not there; its packages are unpacked and not configured, which is enough for Python.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=${MEDIAL_AXIS_BLENDERS:-$here/../../build/blenders}/bookworm-arm64
if [ ! -d "$folder" ]; then
  mkdir -p "$(dirname "$folder")"
  rm -rf "$folder.new"
  mmdebstrap --quiet --arch=arm64 --variant=extract \
    --include=python3,python3-numpy,python3-scipy,python3-pytest,python3-pytest-xdist bookworm "$folder.new" \
    "$(cd "$here/../.." && python3 -c 'from tools.packaging import debian; print(debian.mirror())')" >&2
  mv "$folder.new" "$folder"
fi
folder=$(cd "$folder" && pwd)
libraries=$folder/usr/lib/aarch64-linux-gnu
exec qemu-aarch64-static -L "$folder" -E "LD_LIBRARY_PATH=$libraries/blas:$libraries/lapack" \
  -E "PYTHONHOME=$folder/usr" -E "PYTHONPATH=$folder/usr/lib/python3/dist-packages" "$folder/usr/bin/python3.11" "$@"
