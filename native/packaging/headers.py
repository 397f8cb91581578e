# SPDX-License-Identifier: GPL-3.0-or-later
"""The headers of another Python, and of a pybind11 that knows it, in a folder that the compiler is given.

They come from the packages of another Debian suite. Nothing is installed, and only python3.X/, its pyconfig.h and
pybind11/ are taken from the packages: headers of another C library never meet the compiler's own. Headers that cannot
be had are a Failure.
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from .debian import download, extract, labels
from .headers_for_windows import fetch_for_windows

STAMP = "packages.txt"  # written last: what was unpacked, by version


def fill(folder: Path, version: str, suite: str, windows: bool = False) -> list[str]:
    """Fill the folder, unless it is full; returns what it came from, such as ['pybind11-dev 3.1.0-1']."""
    if not (folder / STAMP).exists():
        bring = fetch_for_windows if windows else fetch
        fresh = folder.with_name(f"{folder.name}.new")
        shutil.rmtree(fresh, ignore_errors=True)
        names = bring(version, suite, fresh)
        (fresh / STAMP).write_text("\n".join(names) + "\n", encoding="utf-8")
        shutil.rmtree(folder, ignore_errors=True)
        fresh.rename(folder)
    return origin(folder)


def origin(folder: Path) -> list[str]:
    """The packages that filled a folder, with their versions."""
    return (folder / STAMP).read_text(encoding="utf-8").splitlines()


def fetch(version, suite, folder):
    """The headers of Debian's packages."""
    with tempfile.TemporaryDirectory() as private:
        packages = download(Path(private), suite, [f"libpython{version}-dev", "pybind11-dev"])
        extract(packages, Path(private, "all"))
        include = Path(private, "all/usr/include")
        for path in (include / "pybind11", *include.glob(f"**/python{version}")):
            shutil.copytree(path, folder / path.relative_to(include))
    return labels(packages)
