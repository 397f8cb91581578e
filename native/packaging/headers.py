# SPDX-License-Identifier: GPL-3.0-or-later
"""The headers of another Python, and of a pybind11 that knows it, in a folder that the compiler is given.

Most come from Debian's packages of another suite. Nothing is installed, and of the packages only python3.X/, its
pyconfig.h and pybind11/ are taken: headers of another C library never meet the compiler's own. A Python that no
Debian has is taken from this machine. What cannot be had is a Failure.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path

from .debian import download, extract, labels
from .headers_for_windows import fetch_for_windows
from .terminal import Failure

INSTALLED = "installed"  # instead of a suite
# Where Pythons lie that are not on PATH.
FOLDERS = ("/usr/bin", "/usr/local/bin", str(Path.home() / ".pyenv/versions/{}*/bin"))
TELL = """
import platform, sysconfig
print(sysconfig.get_path("include"), sysconfig.get_config_h_filename(), platform.python_version())
"""
STAMP = "packages.txt"  # written last: what was unpacked, by version


def fill(folder: Path, version: str, suite: str, windows: bool = False) -> list[str]:
    """Fill the folder, unless it is full; returns what it came from, such as ['pybind11-dev 3.1.0-1']."""
    if not (folder / STAMP).exists():
        bring = copy if suite == INSTALLED else fetch_for_windows if windows else fetch
        fresh = folder.with_name(f"{folder.name}.new")
        shutil.rmtree(fresh, ignore_errors=True)
        names = bring(version, suite, fresh)
        (fresh / STAMP).write_text("\n".join(names) + "\n", encoding="utf-8")
        shutil.rmtree(folder, ignore_errors=True)
        fresh.rename(folder)
    return origin(folder)


def origin(folder: Path) -> list[str]:
    """What a full folder came from."""
    return (folder / STAMP).read_text(encoding="utf-8").splitlines()


def copy(version, _, folder):
    """The headers of a Python of this machine; its pybind11 is the compiler's own."""
    for python in interpreters(version):
        done = subprocess.run([python, "-c", TELL], capture_output=True, text=True)
        include, config, found = (done.stdout.split() or [""] * 3)[:3]
        if include and Path(include, "Python.h").exists() and Path(config).exists():
            shutil.copytree(include, folder / f"python{version}")
            shutil.copy(config, folder / f"python{version}" / "pyconfig.h")
            return [f"that of {python.parent}, {found}"]
    raise Failure(f"expected a python{version} with its headers; Debian has none to install")


def interpreters(version):
    """The Pythons of a version on this machine."""
    name = f"python{version}"
    on_path = [Path(found)] if (found := shutil.which(name)) else []
    patterns = [f"{folder.format(version)}/{name}"[1:] for folder in FOLDERS]
    return on_path + [path for pattern in patterns for path in sorted(Path("/").glob(pattern))]


def fetch(version, suite, folder):
    """The headers of Debian's packages."""
    with tempfile.TemporaryDirectory() as private:
        packages = download(Path(private), suite, [f"libpython{version}-dev", "pybind11-dev"])
        extract(packages, Path(private, "all"))
        include = Path(private, "all/usr/include")
        for path in (include / "pybind11", *include.glob(f"**/python{version}")):
            shutil.copytree(path, folder / path.relative_to(include))
    return labels(packages)
