#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# enter.sh FOLDER PROGRAM ...: runs a program inside a chroot, which sees this checkout, /tmp and the test data
# under their own names. The mounts are gone when it ends. Needs root.
set -eu
checkout=$(cd "$(dirname "$0")/../.." && pwd)
exec unshare --mount -- sh -euc '
  checkout=$1 folder=$2
  shift 2
  mount -t proc proc "$folder/proc"
  for path in /tmp "$checkout" "${MEDIAL_AXIS_TEST_DATA:-}"; do
    [ -d "$path" ] || continue
    mkdir -p "$folder$path"
    mount --bind "$path" "$folder$path"
  done
  exec chroot "$folder" "$@"' enter "$checkout" "$@"
