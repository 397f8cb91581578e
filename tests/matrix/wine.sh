#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# wine.sh FOLDER ARGUMENT...: runs FOLDER/python.exe, a Python for Windows, with the packages of FOLDER/site.
# Windows knows this machine's files as drive Z; a path from / on is on it as long as the current folder is.
set -euo pipefail
folder=$1
shift
wine=$(command -v wine64 || echo /usr/lib/wine/wine64)
export WINEPREFIX=$folder/prefix WINEARCH=win64 WINEDEBUG=-all PYTHONHOME="Z:${folder//\//\\}"
export PYTHONPATH="Z:${folder//\//\\}\\site" PYTHONDONTWRITEBYTECODE=1 PYTHONUTF8=1
# Python does not start on handles of files: only pipes, by way of cat.
"$wine" "$folder/python.exe" "$@" </dev/null 2>&1 | cat
