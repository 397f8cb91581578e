# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the cost and the quality of samples of a triangulated surface: a Markdown table.

    python3 lab/benchmarks/sampling.py [--output table.md] [--threads N]

A torus of 500,556 triangles, a box of 12, sharp edges of CAD, and smooth and graded samples. CPU seconds of all threads
together. Apart: least distance of SURFACE samples to any other, in spacings. Hole: the largest distance of 200,000
places on the flat triangles to a sample, in disc radii (not for smooth and graded samples). The fandisk needs the
optional data folder (MEDIAL_AXIS_TEST_DATA).
"""

import sys
import time
from collections.abc import Iterator

import _module
import numpy as np

medial = _module.load()

from scipy.spatial import cKDTree  # noqa: E402
from support import (  # noqa: E402
    distance,
    meshes,
)

HEADER = ["mesh", "triangles", "options", "samples", "CPU s", "wall s", "apart", "hole"]


def cases() -> Iterator[tuple[str, meshes.Mesh, str, dict]]:
    fine, box = meshes.torus(around=707, across=354), meshes.box((1, 1, 1))
    yield "torus", fine, "count", {"count": 1_000_000}
    yield "torus", fine, "count, smooth", {"count": 1_000_000, "smooth": True}
    yield "torus", fine, "count", {"count": 10_000}
    yield "box", box, "count", {"count": 1_000_000}
    sites = medial.sample_surface(*meshes.torus(), count=100_000).points
    spacings = 0.008 * 10.0 ** (0.5 * sites[:, 0])
    yield "torus", meshes.torus(), "sizing", {"sizing": (sites, spacings)}
    file = _module.DATA / "fandisk_large.off"
    if file.is_file():
        yield file.name, meshes.read(file), "count", {"count": 100_000}


def row(name: str, mesh: meshes.Mesh, words: str, options: dict, threads: int) -> list[str]:
    wall, cpu = time.perf_counter(), time.process_time()
    samples = medial.sample_surface(*mesh, threads=threads, **options)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    surface = samples.kind == int(medial.SampleKind.SURFACE)
    tree = cKDTree(samples.points)
    apart, hole = tree.query(samples.points[surface], k=2)[0][:, 1].min(), "-"
    if "count" in options and not options.get("smooth"):
        rng = np.random.default_rng(0)
        places = distance.points_on_triangles(mesh[0][mesh[1]], 200_000, rng)
        hole = f"{tree.query(places)[0].max() / samples.radius.max():.2f}"
    spacing = np.sqrt(2 * samples.area / np.sqrt(3) / len(samples.points))
    cells = [name, str(len(mesh[1])), words, str(len(samples.points)), f"{cpu:.2f}"]
    cells += [f"{wall:.2f}", f"{apart / spacing:.3f}" if "count" in options else "-", hole]
    print(" | ".join(cells), file=sys.stderr, flush=True)
    return cells


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    options = parser.parse_args()
    rows = [row(*case, options.threads) for case in cases()]
    _module.publish(_module.markdown(HEADER, rows), options.output)


if __name__ == "__main__":
    main()
