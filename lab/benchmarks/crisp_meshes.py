# SPDX-License-Identifier: GPL-3.0-or-later
"""Folds and crossings of the axes of real meshes, without and with exact places: a Markdown table.

    python3 lab/benchmarks/crisp_meshes.py [--output table.md] [--meshes spot_low.obj ...] [--samples 16000]

The form Clean of every mesh of the data folder that has faces, sampled as Sampling Surface does. Folds are facets that
are turned over, run back along themselves or cross themselves; crossings are pairs of triangles without a common
vertex that go through each other. Betti numbers are pieces, loops and cavities. The data folder is
MEDIAL_AXIS_TEST_DATA; meshes of it that are not there are left out.
"""

import sys
from typing import Any

import _module
import numpy as np

medial = _module.load()

import medial_axis  # noqa: E402  (found through _module)
from support import crisp_measures, crossing_triangles, meshes  # noqa: E402

MESHES = ["3holes.off", "fandisk_large.off", "engine_parts.ply", "rocker-arm.off"]
MESHES += ["screwdriver.off", "openscad-nonmanifold-crash.obj", "club.off", "knot1.off"]
MESHES += ["spot_low.obj", "mannequin.off", "foot.off", "hand_closed.obj", "human_woman.obj"]
MESHES += ["elephant-with-holes.off", "dilo.off", "stanford-bunny.obj", "liver.ply", "igea.ply"]
MESHES += ["engine_skin_large.ply"]

HEADER = ["mesh", "samples", "facets", "folds without", "folds", "share", "crossings without"]
HEADER += ["crossings", "Betti without", "Betti"]


def row(name: str, count: int) -> list[str]:
    points, triangles = meshes.read(_module.DATA / name)
    made = [
        medial_axis.compute(points, triangles, sampling="surface", samples=count, crisp=crisp)
        for crisp in (False, True)
    ]
    outputs = [crisp_measures.output_of(one, np.eye(3)) for one in made]
    folds = [int(one.rings().folded().sum()) for one in outputs]
    pairs = [len(crossing_triangles.crossing_pairs(one.vertices, one.triangles)) for one in outputs]
    facets = len(outputs[1].across)
    share = f"{folds[1] / max(facets, 1):.0e}" if folds[1] else "0"
    counts = [f"{len(made[1].chosen.samples.points):,}", f"{facets:,}"]
    return [
        name.rsplit(".", 1)[0],
        *counts,
        *(f"{value:,}" for value in folds),
        share,
        *(f"{value:,}" for value in pairs),
        *(betti_of(one) for one in made),
    ]


def betti_of(made: Any) -> str:
    return ", ".join(str(number) for number in made.axis.level.betti)


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--meshes", nargs="+", default=MESHES, help="files of the data folder")
    parser.add_argument("--samples", type=int, default=16_000)
    options = parser.parse_args()
    table = []
    for name in options.meshes:
        if not (_module.DATA / name).exists():
            continue
        table.append(row(name, options.samples))
        print(" | ".join(table[-1]), file=sys.stderr, flush=True)
    _module.publish(_module.markdown(HEADER, table), options.output)


if __name__ == "__main__":
    main()
