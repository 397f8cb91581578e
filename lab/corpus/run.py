# SPDX-License-Identifier: GPL-3.0-or-later
"""One mesh by the product's own command line, at the defaults, in a process of its own with limits."""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import ROOT
from .meshes import Mesh

WAITING = 10  # a process may take this many times its limit of processor time by the clock
MEGABYTE = 1 << 20


@dataclass(frozen=True)
class Limits:
    """Seconds of processor time of all threads, and memory that is written."""

    seconds: int = 120
    megabytes: int = 4096

    def set(self) -> None:
        """Limit the process that calls this."""
        resource.setrlimit(resource.RLIMIT_CPU, (self.seconds, self.seconds + 1))
        resource.setrlimit(resource.RLIMIT_DATA, (self.megabytes * MEGABYTE,) * 2)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


@dataclass(frozen=True)
class Run:
    """The end of a process: `exit` is its exit code or, negative, the signal that ended it; `report` its JSON."""

    exit: int
    seconds: float
    report: dict[str, Any]
    error: str


def run(mesh: Mesh, output: Path, limits: Limits, nice: int = 0) -> Run:
    """Compute the axis of a mesh as a file."""
    folder = output.parent
    command = [sys.executable, "-m", "medial_axis", str(mesh.path), str(output), "--json"]
    files = [folder / "stdout", folder / "stderr"]

    def limit() -> None:
        os.nice(nice)
        limits.set()

    with open(files[0], "wb") as out, open(files[1], "wb") as err:
        process = subprocess.Popen(
            [*command, "--quiet"],
            stdout=out,
            stderr=err,
            env=_environment(folder),
            preexec_fn=limit,
        )
        code, seconds = ended(process, WAITING * limits.seconds)
    said, error = (path.read_text(errors="replace") for path in files)
    return Run(code, seconds, _report(said), error)


def _environment(folder: Path) -> dict[str, str]:
    """In which `python3 -m medial_axis` is the add-on's folder of this checkout."""
    package = folder / "medial_axis"
    if not package.is_symlink():
        package.symlink_to(ROOT / "blender_addon", target_is_directory=True)
    return {**os.environ, "PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}


def ended(process: subprocess.Popen, most: float) -> tuple[int, float]:
    """The exit code and the seconds of processor time of a process, which is killed if it waits for too long."""
    timer = threading.Timer(most, process.kill)
    timer.start()
    try:
        _, status, used = os.wait4(process.pid, 0)
    finally:
        timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, used.ru_utime + used.ru_stime


def _report(said: str) -> dict[str, Any]:
    try:
        return json.loads(said.splitlines()[-1])
    except (IndexError, ValueError):
        return {}
