# SPDX-License-Identifier: GPL-3.0-or-later
"""Small medial meshes of the data folder: how far off, Betti numbers and seconds, as a Markdown table.

    python3 lab/benchmarks/small_meshes.py [--meshes hand_closed.obj ...] [--vertices 50 200 1000]

The clean axis of one click is reduced. Mean: distance of the mesh to the surface of the small mesh's solid, by area.
Largest: of both directions the larger. Both in percent of the diagonal. Seconds of processor time, of the reduction
alone. The data folder is MEDIAL_AXIS_TEST_DATA; meshes of it that are not there are left out.
"""

import argparse
import time

import _module
import numpy as np

_module.load()

from lab.race.betti import betti  # noqa: E402 - the module puts the root on the path
from lab.race.read_axis import Complex  # noqa: E402

HEADER = ["mesh", "its axis", "vertices", "mean", "largest", "Betti numbers before", "after", "s"]
MESHES = ("hand_closed.obj", "dilo.off", "rocker-arm.off", "3holes.off")


def betti_of(axis):
    """Counted by the judge of the race, which knows nothing of the reduction."""
    edges = np.sort(np.asarray(axis.edges, np.int64).reshape(-1, 2), axis=1)
    facets = np.asarray(axis.face_offsets, np.int64), np.asarray(axis.face_vertices, np.int64)
    return betti(Complex(axis.vertices, *facets, edges, np.empty(0, np.int64)))


def rows(name, counts):
    import medial_axis
    from medial_axis.core.rebuild.reduce import reduced_difference

    shape = medial_axis.read(_module.DATA / name)
    axis = medial_axis.compute(shape.points, shape.triangles).axis
    for wanted in counts:
        start = time.process_time()
        small = medial_axis.reduce(axis, wanted)
        seconds = time.process_time() - start
        off = reduced_difference(small, shape)
        figures = [f"{100 * off.mean:.3f}", f"{100 * off.largest:.2f}"]
        figures += [str(betti_of(axis)), str(betti_of(small)), f"{seconds:.1f}"]
        yield [name, f"{len(axis.vertices):,}", f"{len(small.vertices):,}", *figures]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--meshes", nargs="+", default=MESHES)
    parser.add_argument("--vertices", nargs="+", type=int, default=(50, 200, 1000))
    wanted = parser.parse_args()
    print("| " + " | ".join(HEADER) + " |\n|" + "---|" * len(HEADER))
    for name in wanted.meshes:
        if not (_module.DATA / name).exists():
            print(f"{name} is not there")
            continue
        for row in rows(name, wanted.vertices):
            print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
