# SPDX-License-Identifier: GPL-3.0-or-later
"""Trials of memory: the forecast against the use of a process; few threads in every command."""

import os
import resource
import subprocess
import sys
from pathlib import Path

import numpy as np
from medial_axis.core.machine.memory_limit import Use, memory_needed
from medial_axis.core.settings import Side
from test_memory import PEAK, ball

from .inside import ROOT, Random
from .outside import _no_traceback, _run, _shapes, environment
from .written import ENDED, WORKS

MEGABYTE = 1 << 20
SMALL = (
    16 * MEGABYTE
)  # what a process takes for modules, threads and the input, for any number of points
NOBODY = 61_234  # who has no processes, so that a limit of them is one of threads


def told(random: Random, folder: Path) -> None:
    """The forecast is within 15 % of the peak, but for the memory of any process; the solids have no symmetry.

    Where the outer side is wanted it may be too high: how many facets lie there depends on the hollows of a solid (a
    convex one has none), and only the analysis knows.
    """
    points, triangles = _solid(random)
    faces, side = bool(random.integers(0, 2)), str(random.choice(["inner", "both", "outer"]))
    form = str(random.choice(["published", "clean"])) if side == "inner" else "published"
    suffix = str(random.choice([".npz", ".ply", ".ma"]))
    arrays = {"points": points, **({"triangles": triangles} if faces else {})}
    np.savez(folder / "in.npz", **arrays)
    words = [ROOT / "tests/python", folder / "in.npz", folder / f"out{suffix}", side, form]
    command = [sys.executable, "-c", PEAK, *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-300:]
    code, found = map(int, done.stdout.split()[-2:])
    levels = form != "published"
    crisp = len(triangles) if faces and levels else 0
    use = Use(faces=faces, side=Side[side.upper()], levels=levels, output=suffix, triangles=crisp)
    said = memory_needed(len(points), use)
    at = f"{len(points):,} points, {faces=}, {side}, {form}, {suffix}: {found / said:.3f} of {said:,}"
    print(f"memory {at}", flush=True)
    nothing_outside = side == "outer" and "no facet passes" in done.stderr
    assert code == 0 or (code == 1 and nothing_outside), (at, done.stderr[-300:])
    assert found <= 1.15 * said + SMALL, at
    assert side != "inner" or 0.85 * said - SMALL <= found, at


def _solid(random: Random) -> tuple[np.ndarray, np.ndarray]:
    """An ellipsoid with waves on it, long or short, of 20,000 to 250,000 vertices."""
    shape = ball(rings=int(10.0 ** random.uniform(2.0, 2.55)))
    sphere = shape.points / np.linalg.norm(shape.points, axis=1)[:, None]
    phase, many = random.uniform(0, 6, 3), random.integers(2, 13, 3)
    waves = 1 + random.uniform(0.05, 0.3) * np.sin(many * sphere + phase).prod(axis=1)
    size = 10.0 ** random.uniform(-3, 3) * random.uniform(0.3, 1, 3)
    return sphere * waves[:, None] * size, shape.triangles


def few_threads(random: Random, folder: Path) -> None:
    """Fewer processes than it asks for threads: it goes on with fewer, or says so.

    It ends with a result and exit code 0 or 6, or with exit code 1 or 3, one sentence and no file at all.
    """
    count = int(random.integers(1, 5))

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_NPROC, (count, count))
        if os.geteuid() == 0:  # whom no limit binds
            os.setgid(NOBODY)
            os.setuid(NOBODY)

    for room in (folder, folder.parent, Path(environment()["PYTHONPATH"])):
        room.chmod(room.stat().st_mode | 0o055)
    folder.chmod(0o777)
    (name,) = _shapes(folder, random, 1, int(10 ** random.uniform(2, 4.3)))
    command = str(random.choice(sorted(WORKS)))
    words, suffixes = WORKS[command]
    output = f"a{random.choice(suffixes)}"
    if command == "axis":
        words = ["--side", str(random.choice(["inner", "both", "outer"]))]
    code, _, err = _run(folder, *words, name, output, preexec_fn=limit)
    if b"OpenBLAS" in err:
        return  # NumPy itself does not load with so few threads
    at = (f"{count} processes", command, output, code, err.decode(errors="replace")[-400:])
    _no_traceback(err)
    assert code in (*ENDED, 1, 3), at
    (folder / name).unlink()
    there = {path.name for path in folder.iterdir()}
    if code in ENDED:
        assert output in there and there <= {output, f"{output}.json"}, (at, there)
        return
    assert err.startswith(b"medial_axis: "), at
    assert not there, (at, there)
