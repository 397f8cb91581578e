# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles `_medial` for each Python into blender_addon/lib, with headers from Debian's packages."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

from . import headers, paths
from .blender import blender_python
from .terminal import Failure, build_preset, output_of, run, say

# The Pythons of the Blenders that the zip is for, and the suite of Debian that has their headers.
PYTHONS = {"3.11": "bookworm", "3.13": "trixie", "3.14": "sid"}
WINDOWS_PYTHONS = {"3.11": "bookworm", "3.13": "trixie"}

_IMPORT = """
import importlib.util, sys
spec = importlib.util.spec_from_file_location("_medial", sys.argv[1])
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
print("imports as _medial", module.__version__)
"""


def build_core() -> None:
    """Compile what knows no Python, and so can be compiled before Blender is there."""
    say("Compiling the core")
    options = ("-DMEDIAL_TESTS=OFF", "-DMEDIAL_PYTHON=OFF")
    build_preset("release", *options, targets=["medial"])


def build_modules(
    blender: Path, local: bool = False, windows: bool = False, tests: bool = False
) -> None:
    """Compile the release modules into blender_addon/lib: for Blender's own Python and, unless `local`, the others.

    With `tests` the native tests are compiled as well.
    """
    say("Building the native modules")
    python, abi = blender_python(blender)
    folders = {} if local else other_headers(abi)
    options = [f"-DPython_EXECUTABLE={python}", "-DMEDIAL_PYTHON=ON", _definition_of(folders)]
    options += [f"-DMEDIAL_TESTS={'ON' if tests else 'OFF'}"]
    targets = ["_medial", *(f"_medial_{_digits(version)}" for version in folders)]
    build_preset("release", *options, targets=[] if tests else targets)
    abis = [abi, *(re.sub(r"\d+", _digits(version), abi, count=1) for version in folders)]
    modules = [_put_into_library(paths.BUILD / "release" / f"_medial.{abi}.so") for abi in abis]
    modules += _build_for_windows() if windows else []
    for old in set(paths.LIBRARY.glob("_medial.*")) - set(modules):
        old.unlink()
    checker = Path(__file__).with_name("check_module.py")
    run(sys.executable, checker, *modules, *(["--local"] if local else []))
    print(output_of(python, "-c", _IMPORT, modules[0]).strip())


def _digits(version: str) -> str:
    """The version as names of modules have it: 311 for 3.11."""
    return version.replace(".", "")


def _build_for_windows() -> list[Path]:
    folders = _headers_of(WINDOWS_PYTHONS, paths.BUILD / "python" / "windows", windows=True)
    build_preset("mingw", _definition_of(folders))
    names = [f"_medial.cp{_digits(version)}-win_amd64.pyd" for version in folders]
    strip = "x86_64-w64-mingw32-strip"
    return [_put_into_library(paths.BUILD / "mingw" / name, strip) for name in names]


def _definition_of(folders: dict[str, Path]) -> str:
    return f"-DMEDIAL_PYTHON_HEADERS={';'.join(map(str, folders.values()))}"


def other_headers(abi: str) -> dict[str, Path]:
    """Folders with the headers of the Pythons that Blender here does not use, by version."""
    others = {
        version: suite
        for version, suite in PYTHONS.items()
        if f"cpython-{_digits(version)}-" not in abi
    }
    return _headers_of(others, paths.BUILD / "python")


def _headers_of(pythons: dict[str, str], parent: Path, windows: bool = False) -> dict[str, Path]:
    """Folders with headers, by version; those not to be had are named."""
    folders = {}
    for version, suite in pythons.items():
        try:
            origin = headers.fill(parent / version, version, suite, windows)
        except Failure as reason:
            print(f"No module for Python {version}: {reason}")
        else:
            print(f"Python {version}: {', '.join(origin)}")
            folders[version] = parent / version
    return folders


def _put_into_library(built: Path, strip: str = "strip") -> Path:
    """Strip a module into blender_addon/lib; renamed at the end: a running Blender keeps the file that it has open."""
    if not built.exists():
        raise Failure(f"Expected {paths.shown(built)}, found none; run clean first")
    paths.LIBRARY.mkdir(exist_ok=True)
    module = paths.LIBRARY / built.name
    fresh = module.with_suffix(".new")
    run(strip, "--strip-unneeded", "-o", fresh, built)
    os.replace(fresh, module)
    return module
