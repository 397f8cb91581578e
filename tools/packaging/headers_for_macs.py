# SPDX-License-Identifier: GPL-3.0-or-later
"""Headers of Python as it is on Macs, and its library, whose names check_module.py compares with those of a module.

They come from the package index of Java, in which JavaCPP publishes whole Pythons: Debian's packages have no
configuration for Macs.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
import zipfile
from pathlib import Path

from .debian import download, extract, labels, require
from .terminal import Failure

# There is no Python 3.11 for Apple's processors; its headers are the same, but for the size of a long double, which
# neither Python's headers nor pybind11 ask for.
ARTIFACTS = {
    "3.11": "org.bytedeco:cpython:3.11.3-1.5.9:jar:macosx-x86_64",
    "3.13": "org.bytedeco:cpython:3.13.0-1.5.11:jar:macosx-arm64",
}


def fetch_for_macs(version: str, suite: str, folder: Path) -> list[str]:
    """Python's headers and library, and pybind11 of a Debian suite; returns what they came from."""
    require("mvn")
    with tempfile.TemporaryDirectory() as private:
        (archive,) = _copy_artifact(ARTIFACTS[version], Path(private, "jar"))
        packages = download(Path(private, "packages"), suite, ["pybind11-dev"])
        extract(packages, Path(private, "all"))
        shutil.copytree(Path(private, "all/usr/include/pybind11"), folder / "pybind11")
        unpack_python(archive, version, folder)
        return [ARTIFACTS[version], *labels(packages)]


def _copy_artifact(artifact: str, folder: Path) -> list[Path]:
    words = ["mvn", "-q", "-B", "dependency:copy", f"-Dartifact={artifact}"]
    done = subprocess.run(
        [*words, f"-DoutputDirectory={folder}"], capture_output=True, text=True, cwd=folder.parent
    )
    if done.returncode != 0:
        reason = (done.stdout.strip().splitlines() or ["no reason given"])[0]
        raise Failure(f"{artifact} could not be had: {reason}")
    return sorted(folder.glob("*.jar"))


def unpack_python(archive: Path, version: str, folder: Path) -> None:
    """python3.X/ and libpython3.X.dylib out of the archive."""
    library, headers = f"libpython{version}.dylib", f"include/python{version}/"
    with zipfile.ZipFile(archive) as files:
        for name in files.namelist():
            _, marked, header = name.partition(f"/{headers}")
            if name.endswith(f"/{library}"):
                target = folder / library
            elif marked and header and not name.endswith("/"):
                target = folder / f"python{version}" / header
            else:
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(files.read(name))
