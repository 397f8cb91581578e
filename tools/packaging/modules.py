# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles `_medial` for each Python into blender_addon/lib, with headers from Debian's packages."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable
from pathlib import Path

from . import headers, library, other_systems, paths
from .blender import blender_python
from .terminal import build_preset, output_of, run, say

# The Pythons of the Blenders that the zip is for, and the suite of Debian that has their headers.
PYTHONS = {"3.11": "bookworm", "3.13": "trixie", "3.14": "sid"}

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
    blender: Path,
    local: bool = False,
    systems: Iterable[str] = (),
    tests: bool = False,
    beside: Iterable[str] = (),
) -> None:
    """Compile the release modules into blender_addon/lib: for Blender's own Python and, unless `local`, the others, and
    those for other systems, named as in other_systems.py. With `tests` the native tests are compiled as well; the
    targets `beside` are those of the laboratory.
    """
    say("Building the native modules")
    python, abi = blender_python(blender)
    folders = {} if local else other_headers(abi)
    options = [
        f"-DPython_EXECUTABLE={python}",
        "-DMEDIAL_PYTHON=ON",
        headers.definition_of(folders),
    ]
    options += [f"-DMEDIAL_TESTS={'ON' if tests else 'OFF'}"]
    targets = [*beside, "_medial", *(f"_medial_{headers.digits(version)}" for version in folders)]
    build_preset("release", *options, targets=[] if tests else targets)
    abis = [abi, *(re.sub(r"\d+", headers.digits(version), abi, count=1) for version in folders)]
    modules = [library.put(paths.BUILD / "release" / f"_medial.{abi}.so") for abi in abis]
    for system in systems:
        modules += other_systems.BUILDERS[system]()
    for old in set(paths.LIBRARY.glob("_medial.*")) - set(modules):
        old.unlink()
    checker = Path(__file__).with_name("check_module.py")
    run(sys.executable, checker, *modules, *(["--local"] if local else []))
    print(output_of(python, "-c", _IMPORT, modules[0]).strip())


def other_headers(abi: str) -> dict[str, Path]:
    """Folders with the headers of the Pythons that Blender here does not use, by version."""
    others = {
        version: suite
        for version, suite in PYTHONS.items()
        if f"cpython-{headers.digits(version)}-" not in abi
    }
    return headers.folders_of(others, paths.BUILD / "python")
