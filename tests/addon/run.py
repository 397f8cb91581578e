#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs the add-on's zip into a private Blender profile and runs the tests inside that Blender.

    python3 tests/addon/run.py --zip dist/medial_axis-VERSION.zip [--blender blender] [pytest arguments]
    python3 tests/addon/run.py --zip ... --bpy PYTHON [pytest arguments]
    python3 tests/addon/run.py --zip ... --gui [--keep FOLDER] [scenes]
    python3 tests/addon/run.py --zip ... --script FILE [arguments]

Without --zip the add-on's sources and compiled modules are packed first. --bpy takes a Python with
Blender as a module instead of a Blender. --gui drives Blender's window under Xvfb with xdotool; its
screenshots and logs are written to the folder that --keep names. With --claims, processes that share
a folder share the files of tests, or the scenes. --script runs another script than the tests. The
exit code is 0 when every test passed.
"""

from __future__ import annotations

import argparse
import shlex
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from tools.packaging import blender as private  # noqa: E402 - the line above makes it found
from tools.packaging import pack, paths  # noqa: E402
from tools.packaging.terminal import Failure  # noqa: E402

EXTENSION = f"bl_ext.user_default.{paths.PACKAGE}"


class Blender(private.Blender):
    """A Blender into which the zip is installed."""

    def install(self, archive: Path) -> str:
        """Install and enable the zip; returns the module name that it got."""
        if self.version() < (4, 2):
            self.script(HERE / "install.py", archive)
            return paths.PACKAGE
        words = ("--command", "extension", "install-file", "-r", "user_default", "--enable")
        self.run(*words, archive)
        return EXTENSION


# Python does not get to its end: there bpy 4.2 crashes once a single handler, property or panel was registered.
RUN_AND_LEAVE = """
import os, runpy, sys, traceback
code = 1
try:
    runpy.run_path(sys.argv[1], run_name="__main__")
    code = 0
except SystemExit as end:
    if isinstance(end.code, str):
        print(end.code)
    else:
        code = int(end.code or 0)
except BaseException:
    traceback.print_exc()
sys.stdout.flush()
os._exit(code)
"""


class BpyModule(Blender):
    """Blender as a Python module; `program` is a Python that has it."""

    def script(self, path: Path, *arguments: object, options=(), check: bool = True) -> int:
        return self.run("-c", RUN_AND_LEAVE, path, "--", *arguments, check=check)

    def install(self, archive: Path) -> str:
        self.script(HERE / "install.py", archive)
        return EXTENSION


def pack_sources(folder: Path) -> Path:
    """The sources with the compiled modules as an installable zip."""
    target = folder / f"{paths.PACKAGE}.zip"
    pack.write_zip(target, pack.inside_folder(pack.contents()))
    return target


def main() -> int:
    formatter = argparse.RawTextHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=formatter)
    parser.add_argument("--zip", type=Path, help="the add-on; default: packed from the sources")
    words = "words may stand before it: 'tests/matrix/enter.sh FOLDER blender'"
    parser.add_argument("--blender", default="blender", help=f"the Blender to test; {words}")
    module = "test Blender as a module of this Python; words may stand before it here, too"
    parser.add_argument("--bpy", metavar="PYTHON", help=module)
    parser.add_argument("--script", type=Path, default=HERE / "inside.py", help="what to run")
    window = "drive the window instead of background mode"
    parser.add_argument("--gui", action="store_true", help=window)
    parser.add_argument("--keep", type=Path, help="where --gui leaves its screenshots and logs")
    parser.add_argument("--claims", type=Path, help="where processes note what they take")
    arguments, pytest_arguments = parser.parse_known_args()
    with tempfile.TemporaryDirectory(prefix="medial_axis_test_") as folder:
        kind = BpyModule if arguments.bpy else Blender
        program = shlex.split(arguments.bpy or arguments.blender)
        blender = kind(program, Path(folder) / "profile")
        archive = (arguments.zip or pack_sources(Path(folder))).resolve()
        module = blender.install(archive)
        blender.environment["MEDIAL_AXIS_MODULE"] = module
        if arguments.gui:
            sys.path.insert(0, str(HERE / "gui"))
            import drive

            keep = arguments.keep or Path(folder) / "gui"
            return drive.run_all(blender, keep, pytest_arguments, arguments.claims)
        if arguments.claims:
            pytest_arguments.append(f"--claims={arguments.claims}")
        script, options = arguments.script.resolve(), ["--factory-startup"]
        return blender.script(script, *pytest_arguments, options=options, check=False)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as failure:
        sys.exit(str(failure))
