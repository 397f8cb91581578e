# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact places cost so much beside the bare Delaunay triangulation of the same samples: a Markdown table.

    python3 lab/benchmarks/crisp_cost.py [--output table.md] [--shapes box ellipsoid] [--meshes spot_low.obj]
        [--samples 20000] [--turns 3] [--bare PROGRAM]

wants a build of the release preset with its target `bare_triangulation`. All is done by one processor, where the system
lets a program choose. Figures are seconds of the processor, medians of the turns: of CGAL alone, of the hierarchy
without faces, and of the hierarchy with them, the making of the faces included. What is added over CGAL's is the median
of the ratios of each turn, in which the three follow each other. Meshes are files of the data folder.
"""

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import _module
import measuring

medial = _module.load()

import medial_axis  # noqa: E402  (found through _module)
from hierarchy_cost import BARE  # noqa: E402
from support import crisp_runs, meshes  # noqa: E402

HEADER = ["solid", "triangles", "samples", "triangulation alone", "hierarchy without faces", "with"]
HEADER += ["added / triangulation"]
SHAPES = ["box", "plate", "cylinder", "ellipsoid"]
MESHES = ["spot_low.obj", "hand_closed.obj"]


def row(name: str, made: medial_axis.Computation, turns: int, bare: Path) -> list[str]:
    samples = made.chosen.samples
    with tempfile.TemporaryDirectory(prefix="medial_axis_bench_") as folder:
        measuring.Input(name, samples.points, samples.solid.shape.triangles).write(Path(folder))
        found = measuring.median([turn(made, bare, Path(folder)) for _ in range(turns)])
    counts = [f"{len(samples.solid.shape.triangles):,}", f"{len(samples.points):,}"]
    seconds = [f"{found[name]:.2f}" for name in ("bare", "without", "with")]
    return [name, *counts, *seconds, f"{found['ratio']:.2g}"]


def turn(made: medial_axis.Computation, bare: Path, folder: Path) -> dict[str, float]:
    """Seconds of the processor of the three, and the ratio."""
    samples = made.chosen.samples

    def with_faces() -> None:
        samples.analysis.hierarchy(faces=samples.solid.of_module(medial, made.settings))

    found = {"bare": measuring.bare(bare, folder)["cpu"]}
    found["without"] = seconds_of(samples.analysis.hierarchy)
    found["with"] = seconds_of(with_faces)
    found["ratio"] = (found["with"] - found["without"]) / found["bare"]
    return found


def seconds_of(action: Callable[[], object]) -> float:
    start = time.process_time()
    kept = action()  # noqa: F841  (what it costs to free it is not counted)
    return time.process_time() - start


def computations(options) -> Iterator[tuple[str, medial_axis.Computation]]:
    for name in options.shapes:
        yield name, crisp_runs.Case(name, options.samples).made(True).computation
    for name in options.meshes:
        mesh = meshes.read(_module.DATA / name)
        yield name, medial_axis.compute(*mesh, sampling="surface", samples=options.samples)


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--shapes", nargs="*", default=SHAPES)
    parser.add_argument("--meshes", nargs="*", default=MESHES)
    parser.add_argument("--samples", type=int, default=20_000)
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--bare", type=Path, default=BARE, help="the program that triangulates")
    options = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    rows = (row(name, made, options.turns, options.bare) for name, made in computations(options))
    _module.tell(HEADER, rows, options.output)


if __name__ == "__main__":
    main()
