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
from typing import Callable, List, Optional

from .debian import download, extract, labels
from .terminal import Failure

# Fills a folder with the headers of a version of Python, from a suite; returns what they came from.
Bring = Optional[Callable[[str, str, Path], List[str]]]
STAMP = "packages.txt"  # written last: what was unpacked, by version


def folders_of(pythons: dict[str, str], parent: Path, bring: Bring = None) -> dict[str, Path]:
    """Full folders below `parent`, by version of Python; those not to be had are named. `pythons` has their suites."""
    folders = {}
    for version, suite in pythons.items():
        try:
            names = fill(parent / version, version, suite, bring)
        except Failure as reason:
            print(f"No module for Python {version}: {reason}")
        else:
            print(f"Python {version}: {', '.join(names)}")
            folders[version] = parent / version
    return folders


def definition_of(folders: dict[str, Path]) -> str:
    """CMake's definition of the folders."""
    return f"-DMEDIAL_PYTHON_HEADERS={';'.join(map(str, folders.values()))}"


def digits(version: str) -> str:
    """The version as names of modules have it: 311 for 3.11."""
    return version.replace(".", "")


def fill(folder: Path, version: str, suite: str, bring: Bring = None) -> list[str]:
    """Fill the folder, unless it is full; returns what it came from, such as ['pybind11-dev 3.1.0-1'].

    `bring` fills it for another system than this.
    """
    if not (folder / STAMP).exists():
        bring = bring or fetch
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


def fetch(version, suite, folder, processor=""):
    """The headers of Debian's packages, of this processor or of another."""
    with tempfile.TemporaryDirectory() as private:
        names = [f"libpython{version}-dev", "pybind11-dev"]
        packages = download(Path(private), suite, names, processor)
        extract(packages, Path(private, "all"))
        include = Path(private, "all/usr/include")
        for path in (include / "pybind11", *include.glob(f"**/python{version}")):
            shutil.copytree(path, folder / path.relative_to(include))
    return labels(packages)
