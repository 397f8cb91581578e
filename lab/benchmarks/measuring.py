# SPDX-License-Identifier: GPL-3.0-or-later
"""One measurement in a process of its own: seconds, memory, and how busy the machine was with other things.

    python3 lab/benchmarks/measuring.py FOLDER ours|qhull [--threads N] [--sides NONE]

The folder holds the input, as `Input.write` leaves it. Called as a script, it measures and prints JSON.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

AGAIN = 5  # extracts after the first one; their median counts
# The names that the analysis gives to CGAL's part.
DELAUNAY = ("delaunay", "triangulation")


@dataclass(frozen=True)
class Input:
    """An input to measure: (n, 3) float64 points, and (m, 3) int32 triangles, none for a cloud of points."""

    name: str
    points: NDArray[np.float64]
    triangles: NDArray[np.int32]

    def write(self, folder: Path) -> None:
        np.ascontiguousarray(self.points, np.float64).tofile(folder / "points")
        np.ascontiguousarray(self.triangles, np.int32).tofile(folder / "triangles")

    @classmethod
    def read(cls, folder: Path) -> Input:
        points = np.fromfile(folder / "points", np.float64).reshape(-1, 3)
        return cls("", points, np.fromfile(folder / "triangles", np.int32).reshape(-1, 3))


# --- in the process that starts the others


def in_child(command: list, **options) -> tuple[str, float]:
    """The output of a command, and how many cores other processes kept busy meanwhile."""
    before = time.perf_counter(), _busy(), _children()
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, text=True, **options)
    if done.returncode:
        raise SystemExit(f"{command[0]} ended with {done.returncode}:\n{done.stdout[-3000:]}")
    wall, busy, own = (b - a for a, b in zip(before, (time.perf_counter(), _busy(), _children())))
    return done.stdout, max(0.0, busy - own) / wall


def bare(program: Path, folder: Path) -> dict:
    """CGAL's triangulation by itself."""
    text, others = in_child([program, folder / "points"])
    seconds, cpu, added = text.split()
    return {"seconds": float(seconds), "cpu": float(cpu), "bytes": int(added), "others": others}


def ours(folder: Path, sides: str, threads: int) -> dict:
    """The result of `_ours` in a process of its own."""
    return _of_this_script(folder, "ours", "--sides", sides, "--threads", threads)


def qhull(folder: Path) -> dict:
    """SciPy's triangulation by itself."""
    return _of_this_script(folder, "qhull")


def _of_this_script(*words: object) -> dict:
    text, others = in_child([sys.executable, __file__, *words])
    return {**json.loads(text), "others": others}


def median(values: list) -> object:
    """The median of numbers, or of each value of dictionaries with the same keys."""
    first = values[0]
    if isinstance(first, dict):
        return {key: median([value[key] for value in values]) for key in first}
    return statistics.median(values)


def _busy() -> float:
    """Seconds of all cores that went to anything since the machine started."""
    fields = Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]
    user, nice, system, _, _, *interrupts = (int(x) for x in fields)
    return (user + nice + system + sum(interrupts)) / os.sysconf("SC_CLK_TCK")


def _children() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


# --- in a process of its own


class Memory:
    """Resident bytes in addition to those at the beginning."""

    def __init__(self) -> None:
        Path("/proc/self/clear_refs").write_text("5")  # forgets the highest so far
        self._before = self._bytes("VmRSS")

    @property
    def now(self) -> int:
        return self._bytes("VmRSS") - self._before

    @property
    def peak(self) -> int:
        return self._bytes("VmHWM") - self._before

    @staticmethod
    def _bytes(line: str) -> int:
        """Not ru_maxrss, which a child inherits from its parent."""
        status = Path("/proc/self/status").read_text()
        return int(status.split(line + ":")[1].split()[0]) * 1024


def _ours(work: Input, sides: str, threads: int) -> dict:
    """An analysis, the first extract and the median of those that follow, with the default thresholds."""
    import _module

    medial = _module.load()
    side = medial.Side.BOTH if sides == "NONE" else medial.Side.INNER
    triangles = work.triangles if sides == "SURFACE" else None
    memory, start, cpu = Memory(), time.perf_counter(), time.process_time()
    analysis = medial.MedialAnalysis(
        work.points, triangles, sides=getattr(medial.SidesFrom, sides), threads=threads
    )
    seconds = {"analysis": time.perf_counter() - start}
    kept, peak = memory.now, memory.peak  # in this order, so that the peak is no less
    seconds["extract"] = _seconds(lambda: analysis.extract(side=side))
    cpu = time.process_time() - cpu
    again = [_seconds(lambda: analysis.extract(side=side)) for _ in range(AGAIN)]
    return {
        "seconds": seconds | {"again": statistics.median(again)},
        "cpu": cpu,
        "stages": analysis.timings,
        "facets": len(analysis.extract(side=side).generators),
        "bytes": {"analysis": peak, "with extract": memory.peak, "kept": kept},
    }


def _qhull(work: Input) -> dict:
    from scipy.spatial import Delaunay

    return {"seconds": _seconds(lambda: Delaunay(work.points))}


def _seconds(action) -> float:
    start = time.perf_counter()
    kept = action()  # noqa: F841  (what it costs to free it is not counted)
    return time.perf_counter() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("kind", choices=("ours", "qhull"))
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--sides", default="NONE")
    options = parser.parse_args()
    work = Input.read(options.folder)
    found = _qhull(work) if options.kind == "qhull" else _ours(work, options.sides, options.threads)
    print(json.dumps(found))


if __name__ == "__main__":
    main()
