"""Table 1 of Dey & Zhao beside this implementation, at the same numbers of points; also 100k and 1M points.

    python3 tests/benchmarks/table1.py [--output table.md] [--threads N] [--largest 1000000]

Every row runs in its own process, so that peak memory is its own. Rows: a blue-noise ellipsoid of the paper's
number of points for every object, and a mesh of the same kind where the optional data folder has one
(MEDIAL_AXIS_TEST_DATA). Filter: the analysis without the triangulation and without inside and outside (sides, for
meshes); extract: once, with the paper's thresholds. Bytes per point: what analysis and extract add to the input.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import _module
import numpy as np

# object, points, Delaunay s, filter s (933 MHz PC, CGAL 2.3), stand-in mesh
PAPER = [
    ("3HOLE", 4000, 2.37, 0.82, "3holes.off"),
    ("KNOT", 10001, 8.36, 2.66, "knot1.off"),
    ("ENGINE", 11361, 37.0, 1.82, "engine_parts.ply"),
    ("MANNEQUIN", 12773, 7.79, 2.28, "mannequin.off"),
    ("FANDISK", 16475, 13.4, 3.0, "fandisk_large.off"),
    ("CLUB", 16865, 18.81, 3.06, "club.off"),
    ("FOOT", 20021, 13.24, 3.71, "foot.off"),
    ("HAND", 25626, 51.14, 5.11, "hand_closed.obj"),
    ("SCREWDRIVER", 27152, 51.87, 5.36, "screwdriver.off"),
    ("DINOSAUR", 28098, 23.28, 5.8, "dilo.off"),
    ("HEART", 37912, 32.49, 6.58, "liver.ply"),
    ("ROCKER", 40177, 74.54, 8.25, "rocker-arm.off"),
    ("FEMALE", 121723, 292.85, 24.95, "igea.ply"),
]
HEADER = [
    "object",
    "points",
    "paper Delaunay s",
    "paper filter s",
    "input here",
    "points here",
    "Delaunay s",
    "filter s",
    "sides s",
    "extract s",
    "facets",
    "filter / Delaunay",
    "extract / Delaunay",
    "peak MB",
    "bytes / point",
]


def ellipsoid(count: int) -> np.ndarray:
    """Exactly `count` blue-noise samples: a slightly larger sample without its last rows. Above 200,000 points
    with fewer darts, which takes a minute instead of ten and leaves a few wider gaps."""
    from sampling import saturate
    from shapes import SHAPES

    shape, rng = SHAPES["ellipsoid"], np.random.default_rng(0)
    if count <= 200_000:
        points = shape.sample(int(count * 1.015) + 5, 0)
    else:
        points = saturate(
            shape.candidates, count, np.sqrt(0.51 * shape.area / count), rng, shares=(4,)
        )
    assert len(points) >= count
    return rng.permutation(points)[:count]


def run_one(file: str, threads: int) -> dict:
    """In the child: times, facets and the memory that the analysis added to that of the input."""
    medial = _module.load()
    arrays = np.load(file)
    points, triangles = arrays["points"], arrays["triangles"]
    before = memory("VmRSS")
    start = time.perf_counter()
    analysis = medial.MedialAnalysis(points, triangles if len(triangles) else None, threads=threads)
    middle = time.perf_counter()
    mesh = analysis.extract(side=medial.Side.INNER if len(triangles) else medial.Side.BOTH)
    end = time.perf_counter()
    delaunay, sides = analysis.timings["triangulation"], analysis.timings.get("sides", 0.0)
    return {
        "points": len(points),
        "delaunay": delaunay,
        "filter": middle - start - delaunay - sides,
        "sides": sides,
        "extract": end - middle,
        "facets": len(mesh.generators),
        "peak": memory("VmHWM"),
        "added": memory("VmHWM") - before,
    }


def memory(line: str) -> int:
    """Bytes of a line of /proc/self/status. Not ru_maxrss, which a child inherits from its parent."""
    status = Path("/proc/self/status").read_text()
    return int(status.split(line + ":")[1].split()[0]) * 1024


def in_child(points: np.ndarray, triangles: np.ndarray, threads: int) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "input.npz")
        np.savez(file, points=points, triangles=triangles)
        command = [sys.executable, __file__, "--child", file, "--threads", str(threads)]
        return json.loads(
            subprocess.run(command, check=True, capture_output=True, text=True).stdout
        )


def row(
    label: list[str], name: str, points: np.ndarray, triangles: np.ndarray, threads: int
) -> list[str]:
    r = in_child(points, triangles, threads)
    cells = [
        *label,
        name,
        f"{r['points']}",
        f"{r['delaunay']:.3f}",
        f"{r['filter']:.3f}",
        f"{r['sides']:.3f}" if len(triangles) else "",
        f"{r['extract']:.3f}",
        f"{r['facets']}",
        f"{r['filter'] / r['delaunay']:.2f}",
        f"{r['extract'] / r['delaunay']:.2f}",
        f"{r['peak'] / 1e6:.0f}",
        f"{r['added'] / r['points']:.0f}",
    ]
    print(" | ".join(cells), file=sys.stderr, flush=True)
    return cells


def rows(threads: int, largest: int) -> list[list[str]]:
    from meshes import read

    none, found = np.empty((0, 3), dtype=np.int32), []
    for name, count, delaunay, filtering, file in PAPER:
        label = [name, str(count), f"{delaunay:.2f}", f"{filtering:.2f}"]
        found.append(row(label, "ellipsoid", ellipsoid(count), none, threads))
        if (_module.DATA / file).is_file():
            found.append(row(label, file, *read(_module.DATA / file), threads))
    for count in (100_000, 1_000_000):
        if count <= largest:
            found.append(row(["", "", "", ""], "ellipsoid", ellipsoid(count), none, threads))
    return found


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    parser.add_argument(
        "--largest", type=int, default=1_000_000, help="leave larger ellipsoids out"
    )
    parser.add_argument("--child", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        print(json.dumps(run_one(options.child, options.threads)))
        return
    text = _module.markdown(HEADER, rows(options.threads, options.largest))
    _module.publish(text, options.output)


if __name__ == "__main__":
    main()
