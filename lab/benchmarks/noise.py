# SPDX-License-Identifier: GPL-3.0-or-later
"""Tight Cocone and the inner axis on noisy samples: a Markdown table.

    python3 lab/benchmarks/noise.py [--output table.md] [--samples 8000] [--seeds 3]

Noise: standard deviation of the normal error of every coordinate, in percent of the bounding box's diagonal, and in
spacings: the median distance of a sample to its nearest neighbour. Components, Euler characteristic and samples off the
surface are those of the reconstruction; errors those of the inner facets of the default thresholds, from points of the
output to the true axis (o->t) and back (t->o), in percent of the diagonal. Every figure is the median of the seeds.
"""

import sys

import _module
import numpy as np
from scipy.spatial import cKDTree

medial = _module.load()

from support import (  # noqa: E402
    distance,
    measure,
    topology,
)
from support.shapes import SHAPES  # noqa: E402

SHAPES_AND_EULER = {"torus": 0, "ellipsoid": 2}
PERCENT = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0)
HEADER = [
    "shape",
    "noise %",
    "in spacings",
    "components",
    "Euler",
    "off the surface %",
    "non-manifold edges",
    "flat %",
    "inner facets",
    "o->t mean %",
    "p99",
    "t->o mean %",
    "max",
]


def figures(name: str, percent: float, count: int, seed: int) -> list[float]:
    """The numbers of one row, from the third column on."""
    shape = SHAPES[name]
    clean = shape.sample(count, seed)
    diagonal = float(np.linalg.norm(np.ptp(clean, axis=0)))
    spacing = float(np.median(cKDTree(clean).query(clean, 2)[0][:, 1]))
    noise = percent / 100 * diagonal
    points = clean + np.random.default_rng((seed, 1)).normal(size=clean.shape) * noise
    analysis = medial.MedialAnalysis(points, sides=medial.SidesFrom.TIGHT_COCONE)
    surface = analysis.tight_cocone
    found = [
        noise / spacing,
        topology.components(surface.triangles),
        topology.euler(surface.triangles),
        100 * (~surface.on_surface).mean(),
        surface.nonmanifold_edges,
        100 * surface.flat.mean(),
    ]
    if surface.inner_cells == 0:
        return [*found, 0, *[np.nan] * 4]
    mesh = analysis.extract(side=medial.Side.INNER)
    errors = 100 / diagonal * np.array(axis_errors(mesh, shape))
    return [*found, len(mesh.generators), *errors]


def axis_errors(mesh, shape) -> list[float]:
    """o->t mean and 99th percentile, t->o mean and maximum."""
    triangles = measure.fan_triangles(mesh.vertices, mesh.face_offsets, mesh.face_vertices)
    output = distance.points_on_triangles(triangles, 20000, np.random.default_rng(0))
    there = shape.axis_distance(output)
    back = distance.to_triangles(shape.axis_points(4000), triangles)
    return [there.mean(), np.quantile(there, 0.99), back.mean(), back.max()]


def row(name: str, percent: float, count: int, seeds: int) -> list[str]:
    runs = [figures(name, percent, count, seed) for seed in range(seeds)]
    spacings, components, euler, off, edges, flat, facets, *errors = np.median(runs, axis=0)
    cells = [
        name,
        f"{percent:g}",
        f"{spacings:.2f}",
        f"{components:.0f}",
        f"{int(euler)} ({SHAPES_AND_EULER[name]})",
        f"{off:.2f}",
        f"{edges:.0f}",
        f"{flat:.1f}",
        f"{facets:.0f}",
        *(f"{error:.3f}" for error in errors),
    ]
    print(" | ".join(cells), file=sys.stderr, flush=True)
    return cells


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--samples", type=int, default=8000)
    parser.add_argument("--seeds", type=int, default=3)
    options = parser.parse_args()
    rows = [
        row(name, percent, options.samples, options.seeds)
        for name in SHAPES_AND_EULER
        for percent in PERCENT
    ]
    _module.publish(_module.markdown(HEADER, rows), options.output)


if __name__ == "__main__":
    main()
