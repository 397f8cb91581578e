# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds of the main computations on 1, 2, 4, 8, 16 processors, and whether their bytes are equal: a Markdown table.

    python3 lab/benchmarks/thread_scaling.py [--cores 1 2 4 8 16] [--turns 3] [--small] [--output table.md]

Each turn is a process of its own, which may use so many processors as the row says. Figures are medians of the wall
times of the turns, and in brackets how many times as fast as on the first number of processors.
"""

import hashlib
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import _module
import measuring

medial = _module.load()

import medial_axis  # noqa: E402  (found through _module)
from medial_axis.core.settings import SamplingMode, Settings, ThicknessSettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.thickness.thickness import measure_thickness  # noqa: E402
from output_hashes import ellipsoid  # noqa: E402
from support import meshes  # noqa: E402

HAND = "hand_closed.obj"


def works(small: bool) -> dict[str, Callable[[], Any]]:
    """Names, and what is timed: each gives arrays, whose bytes are compared."""
    points, samples = (20_000, 2_000) if small else (1_000_000, 20_000)
    cloud, hand = ellipsoid(points), meshes.read(_module.DATA / HAND)
    return {
        f"published axis, ellipsoid of {points:,} points": lambda: _arrays(
            medial.MedialAnalysis(cloud).extract()
        ),
        f"click, hand, {samples:,} samples": lambda: _axis(hand, samples, True),
        f"click without crisp places, hand, {samples:,} samples": lambda: _axis(
            hand, samples, False
        ),
        "thickness, hand": lambda: _thickness(hand),
    }


def _arrays(mesh: Any) -> list[Any]:
    return [mesh.vertices, mesh.face_vertices]


def _axis(mesh: tuple, samples: int, crisp: bool) -> list[Any]:
    made = medial_axis.compute(*mesh, sampling="surface", samples=samples, crisp=crisp)
    return _arrays(made.axis)


def _thickness(mesh: tuple) -> list[Any]:
    settings = Settings(sampling=SamplingMode.VERTICES)
    return [measure_thickness(Shape(*mesh), settings, ThicknessSettings()).lengths]


def one(name: str, small: bool) -> dict[str, Any]:
    """Wall and processor seconds of one work in this process, and the hash of its arrays."""
    work = works(small)[name]
    wall, cpu = time.perf_counter(), time.process_time()
    arrays = work()
    found = {"seconds": time.perf_counter() - wall, "cpu": time.process_time() - cpu}
    digest = hashlib.sha256(b"".join(array.tobytes() for array in arrays)).hexdigest()
    return {**found, "hash": digest[:16]}


def in_a_process(name: str, cores: int, small: bool) -> dict[str, Any]:
    words = [sys.executable, __file__, "--one", name, "--cores", str(cores)] + ["--small"] * small
    done = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def row(name: str, options: Any) -> list[str]:
    found = {
        cores: [in_a_process(name, cores, options.small) for _ in range(options.turns)]
        for cores in options.cores
    }
    seconds = {
        cores: measuring.median([turn["seconds"] for turn in turns])
        for cores, turns in found.items()
    }
    first = seconds[options.cores[0]]
    hashes = {turn["hash"] for turns in found.values() for turn in turns}
    cells = [f"{seconds[cores]:.2f} ({first / seconds[cores]:.1f})" for cores in options.cores]
    return [name, *cells, "yes" if len(hashes) == 1 else "NO"]


def rows(options: Any) -> Iterator[list[str]]:
    for name in works(options.small):
        yield row(name, options)


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--cores", type=int, nargs="*", default=[1, 2, 4, 8, 16])
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--small", action="store_true", help="small inputs, to try the script")
    parser.add_argument("--one", help="a work to do in this process, which prints JSON")
    options = parser.parse_args()
    if options.one:
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[: options.cores[0]])
        print(json.dumps(one(options.one, options.small)))
        return
    header = ["work", *(f"{cores}" for cores in options.cores), "same bytes"]
    _module.tell(header, rows(options), options.output)


if __name__ == "__main__":
    main()
