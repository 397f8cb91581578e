# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender with a profile of its own, and the Python that it uses."""

from __future__ import annotations

import functools
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from .terminal import Failure, output_of, with_system_python

_QUERY = (
    "import sys, sysconfig, bpy; print('ABI', bpy.app.version_string.split()[0], "
    "'%d.%d' % sys.version_info[:2], sysconfig.get_config_var('SOABI'))"
)
QUIET = ("--background", "--factory-startup", "--python-exit-code", "1")


class Blender:
    """A Blender with a private profile: the person's own settings are neither read nor written."""

    def __init__(self, program: list[str], folder: Path) -> None:
        self.program = (
            program  # words may stand before the program itself, as those that enter a chroot
        )
        self.environment = {**with_system_python(os.environ), "HOME": str(folder)}
        self.environment["PYTHONDONTWRITEBYTECODE"] = "1"
        self.environment["TMPDIR"] = str(folder)  # Blender saves quit.blend there
        folder.mkdir(parents=True, exist_ok=True)
        for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES", "EXTENSIONS"):
            path = folder / part.lower()
            path.mkdir(parents=True, exist_ok=True)
            self.environment[f"BLENDER_USER_{part}"] = str(path)

    def command(self, *arguments: object) -> list[str]:
        """The words that start it without a window and without a person's settings."""
        return [*self.program, *QUIET, *map(str, arguments)]

    def run(self, *arguments: object, check: bool = True) -> int:
        words = [*self.program, *map(str, arguments)]
        code = subprocess.run(words, env=self.environment).returncode
        if check and code != 0:
            raise Failure(f"{' '.join(words)} ended with exit code {code}")
        return code

    def script(self, path: Path, *arguments: object, options=(), check: bool = True) -> int:
        quiet = ("--background", *options, "--python-exit-code", "1")
        return self.run(*quiet, "--python", path, "--", *arguments, check=check)

    def version(self) -> tuple[int, ...]:
        text = output_of(*self.program, "--version", env=self.environment)
        return tuple(int(part) for part in text.split()[1].split(".")[:2])


def find_blender(name: str) -> Path:
    path = shutil.which(name)
    if path is None:
        raise Failure(
            f"Expected Blender as '{name}', found none; install it or pass --blender PATH", 2
        )
    return Path(path)


@functools.lru_cache(maxsize=None)
def blender_python(blender: Path) -> tuple[Path, str]:
    """The interpreter that Blender uses, with its ABI tag, such as cpython-311-x86_64-linux-gnu."""
    with tempfile.TemporaryDirectory() as folder:
        private = Blender([str(blender)], Path(folder))
        text = output_of(*private.command("--python-expr", _QUERY), env=private.environment)
    found = re.search(r"^ABI (\S+) (\S+) (\S+)$", text, re.MULTILINE)
    if found is None:
        raise Failure(f"Expected {blender} to tell its Python, found: {text.strip()[-200:]}")
    version, python_version, abi = found.groups()
    python = Path(f"/usr/bin/python{python_version}")
    ask = "import sysconfig; print(sysconfig.get_config_var('SOABI'))"
    found = output_of(python, "-c", ask).strip() if python.exists() else "none"
    if found != abi:
        raise Failure(
            f"Blender {version} uses Python {abi}, but {python} is {found}; install python{python_version}-dev",
            2,
        )
    print(f"Blender {version} ({blender}) uses {python}, ABI {abi}")
    return python, abi
