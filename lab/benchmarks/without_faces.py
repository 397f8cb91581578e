# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with and without their faces: does Tight Cocone find the same inside? A Markdown table.

    python3 lab/benchmarks/without_faces.py [--output table.md] [--files igea.ply ...]

Jaccard: of the inner facets (pairs of generators) that the default thresholds select, told from the faces and told by
Tight Cocone; missing and extra: those of one side alone. The figures after that are of Tight Cocone's surface; that of
the mesh itself stands in brackets. Needs the optional data folder (MEDIAL_AXIS_TEST_DATA).
"""

import sys

import _module
import numpy as np

medial = _module.load()

from support import topology  # noqa: E402  (found through _module)
from support.meshes import read  # noqa: E402

FILES = (
    "3holes.off",
    "knot1.off",
    "mannequin.off",
    "rocker-arm.off",
    "screwdriver.off",
    "hand_closed.obj",
    "dilo.off",
    "igea.ply",
    "spot_low.obj",
    "foot.off",
    "club.off",
    "fandisk_large.off",
)
HEADER = [
    "mesh",
    "samples",
    "facets",
    "missing",
    "extra",
    "Jaccard",
    "Euler",
    "components",
    "off the surface",
    "non-manifold edges",
    "and vertices",
    "cavities",
    "not flat %",
]


def inner_facets(analysis) -> np.ndarray:
    """Selected inner facets as one number for each pair of generators."""
    pairs = analysis.edges[analysis.select(side=medial.Side.INNER)].astype(np.int64)
    return pairs[:, 0] * 2**32 + pairs[:, 1]


def row(file: str) -> list[str]:
    points, triangles = read(_module.DATA / file)
    wanted = inner_facets(medial.MedialAnalysis(points, triangles, sides=medial.SidesFrom.SURFACE))
    analysis = medial.MedialAnalysis(points, sides=medial.SidesFrom.TIGHT_COCONE)
    found, surface = inner_facets(analysis), analysis.tight_cocone
    both = len(np.intersect1d(wanted, found))
    return [
        file,
        str(len(surface.samples)),
        str(len(wanted)),
        str(len(wanted) - both),
        str(len(found) - both),
        f"{both / (len(wanted) + len(found) - both):.4f}",
        *(
            f"{figure(surface.triangles)} ({figure(triangles)})"
            for figure in (topology.euler, topology.components)
        ),
        str(int((~surface.on_surface).sum())),
        str(surface.nonmanifold_edges),
        str(surface.nonmanifold_vertices),
        str(surface.cavities),
        f"{100 * (~surface.flat).mean():.2f}",
    ]


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--files", nargs="+", default=FILES)
    options = parser.parse_args()
    rows = []
    for file in options.files:
        rows.append(row(file))
        print(" | ".join(rows[-1]), file=sys.stderr, flush=True)
    _module.publish(_module.markdown(HEADER, rows), options.output)


if __name__ == "__main__":
    main()
