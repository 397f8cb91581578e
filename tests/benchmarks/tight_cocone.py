"""What inside and outside by Tight Cocone cost beside CGAL's bare triangulation of the same points: a Markdown table.

    python3 tests/benchmarks/tight_cocone.py [--output table.md] [--threads N] [--repeats 3]

The bare triangulation is bare_triangulation.cpp, compiled here as the product is (needs a C++ compiler, CGAL and
Boost). It and an analysis take turns; of the repeats the lowest figure of each stage counts, since whatever else the
machine does can only raise it. Sides: the cocone, the manifold, the peeling and the surface, as in an analysis. The
lion needs the optional data folder (MEDIAL_AXIS_TEST_DATA).
"""

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import _module
import numpy as np

medial = _module.load()

from meshes import read  # noqa: E402  (found through _module)
from shapes import SHAPES  # noqa: E402
from table1 import ellipsoid  # noqa: E402

SOURCE = Path(__file__).resolve().parent / "bare_triangulation.cpp"
FLAGS = (
    "-std=c++20 -O3 -DNDEBUG -DCGAL_DISABLE_GMP=1 -DCGAL_NDEBUG=1 -frounding-math -ffp-contract=off"
)
HEADER = ["points", "count", "bare s", "our triangulation s", "sides s", "sides / bare", "inner %"]


def inputs() -> Iterator[tuple[str, np.ndarray]]:
    yield "ellipsoid, random", SHAPES["ellipsoid"].random_sample(100_000, 0)
    yield "ellipsoid, blue noise", ellipsoid(100_000)
    lion = _module.DATA / "lion_scan.ply"
    if lion.is_file():
        yield lion.name, read(lion)[0]


def bare_seconds(program: Path, points: np.ndarray) -> float:
    file = program.with_suffix(".points")
    points.astype(np.float64).tofile(file)
    done = subprocess.run([program, file], check=True, capture_output=True, text=True)
    return float(done.stdout.split()[0])


def row(name: str, points: np.ndarray, program: Path, threads: int, repeats: int) -> list[str]:
    seconds = np.empty((repeats, 3))
    for repeat in seconds:
        repeat[0] = bare_seconds(program, points)
        analysis = medial.MedialAnalysis(
            points, sides=medial.SidesFrom.TIGHT_COCONE, threads=threads
        )
        repeat[1:] = analysis.timings["triangulation"], analysis.timings["sides"]
    bare, triangulation, sides = seconds.min(axis=0)
    inner = analysis.tight_cocone.inner_cells / analysis.cells
    cells = [
        name,
        str(len(points)),
        *(f"{x:.3f}" for x in (bare, triangulation, sides)),
        f"{sides / bare:.2f}",
        f"{100 * inner:.0f}",
    ]
    print(" | ".join(cells), file=sys.stderr, flush=True)
    return cells


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "bare"
        compiler = os.environ.get("CXX", "c++")
        subprocess.run([compiler, *FLAGS.split(), SOURCE, "-o", program], check=True)
        rows = [
            row(name, points, program, options.threads, options.repeats)
            for name, points in inputs()
        ]
    _module.publish(_module.markdown(HEADER, rows), options.output)


if __name__ == "__main__":
    main()
