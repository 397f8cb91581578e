# SPDX-License-Identifier: GPL-3.0-or-later
"""Headers and an import library with which a compiler on Debian makes modules for Windows, without a Windows."""

import re
import shutil
import subprocess
import tarfile
import tempfile
from pathlib import Path

from .debian import download, download_source, extract, labels, require

DLLTOOL = "x86_64-w64-mingw32-dlltool"  # makes an import library
HEADER = re.compile(r"[^/]+/(?:Include/(.+)|PC/(pyconfig\.h)(?:\.in)?)")
# Names that libpython exports, and whether they are functions.
EXPORT = re.compile(r"^\w+ ([A-Z]) (_?Py\w+)", re.MULTILINE)


def fetch_for_windows(version, suite, folder):
    """Python's headers, pybind11's, and the import library libpython3X.a; returns what they came from."""
    require(DLLTOOL)
    with tempfile.TemporaryDirectory() as private:
        source = download_source(Path(private, "source"), suite, f"python{version}")
        names = [f"libpython{version}", "pybind11-dev"]
        packages = download(Path(private, "packages"), suite, names)
        extract(packages, Path(private, "all"))
        shutil.copytree(Path(private, "all/usr/include/pybind11"), folder / "pybind11")
        unpack_headers(source, folder / f"python{version}")
        (exporting,) = Path(private).glob(f"all/usr/lib/*/libpython{version}.so.*.*")
        name = f"python{version.replace('.', '')}"
        make_import_library(exporting, name, folder)
        return labels([source, *packages])


def unpack_headers(source, folder):
    """Python's source knows its configuration on Windows; on other systems it is found out."""
    with tarfile.open(source) as archive:
        for member in archive:
            found = HEADER.fullmatch(member.name)
            if found and member.isfile():
                target = folder / (found[1] or found[2])
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(archive.extractfile(member).read())


def make_import_library(exporting, name, folder):
    """Says that python3X.dll has what Debian's libpython has: the names of Python's interface are the same."""
    symbols = subprocess.check_output(["nm", "-D", "--defined-only", exporting], text=True)
    exports = [name if kind == "T" else f"{name} DATA" for kind, name in EXPORT.findall(symbols)]
    definition = folder / f"{name}.def"
    definition.write_text("\n".join([f"LIBRARY {name}.dll", "EXPORTS", *exports, ""]))
    subprocess.run([DLLTOOL, "-d", definition, "-l", folder / f"lib{name}.a"], check=True)
