# SPDX-License-Identifier: GPL-3.0-or-later
"""The inner axis near sharp edges, by how the edges are sampled: a Markdown table.

    python3 lab/benchmarks/sharp_edges.py [--output table.md] [--count 16000]

Meshes of shapes with exact axes, as they are and turned at random and rounded to float32, and fandisk_large.off when
it is there, whose axis is compared with that of ten times as many samples. Edges: none (no sharp edges at all),
samples (corners and even samples on the edges), and one, two or three rows beside them that mirror each other. Errors
are distances from the output to the axis (o->t) and back (t->o) in percent of the diagonal; off axis is the largest
distance of an output vertex from the axis, in radii of its ball; outside counts vertices outside the solid. Components
and Euler characteristic are those of the facets together.
"""

import sys

import _module
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

medial = _module.load()

from support import (  # noqa: E402
    distance,
    measure,
    meshes,
)
from support.shape_meshes import MESHED  # noqa: E402

EDGES = {
    "none": {"mirrored_rows": 0, "sharp_angle": np.pi},
    "samples": {"mirrored_rows": 0},
    "1 row": {"mirrored_rows": 1},
    "2 rows": {"mirrored_rows": 2},
    "3 rows": {"mirrored_rows": 3},
}
ROTATIONS = {"": Rotation.identity(), "turned": Rotation.random(random_state=1)}
NAMES = ("box", "cylinder", "frustum", "cone")
HEADER = [
    "shape",
    "",
    "edges",
    "samples",
    "facets",
    "o->t mean %",
    "p99",
    "max",
    "t->o mean %",
    "max",
]
HEADER += ["off axis", "outside", "components", "Euler"]
POINTS, TRUTH = 20000, 4000


def inner_axis(vertices, triangles, count: int, smooth: bool, options: dict):
    samples = medial.sample_surface(vertices, triangles, count=count, smooth=smooth, **options)
    analysis = medial.MedialAnalysis(samples.points, triangles, vertices=vertices)
    return len(samples.points), analysis.extract(side=medial.Side.INNER)


def cut(mesh):
    return measure.fan_triangles(mesh.vertices, mesh.face_offsets, mesh.face_vertices)


def topology(mesh) -> list[int]:
    """Components and Euler characteristic."""
    start = np.concatenate(measure.polygons(mesh))
    end = np.concatenate([np.roll(polygon, -1) for polygon in measure.polygons(mesh)])
    edges = np.unique(np.sort(np.column_stack((start, end)), axis=1), axis=0)
    graph = coo_array((np.ones(len(edges)), edges.T), shape=(len(mesh.vertices),) * 2)
    components = connected_components(graph, directed=False)[0]
    return [components, len(mesh.vertices) - len(edges) + len(mesh.generators)]


def exact_row(name: str, turn: str, edges: str, count: int) -> list[str]:
    shape, (vertices, triangles) = MESHED[name]
    diagonal, matrix = np.linalg.norm(np.ptp(vertices, axis=0)), ROTATIONS[turn].as_matrix()
    if turn:
        vertices = (vertices @ matrix.T).astype(np.float32).astype(float)
    samples, mesh = inner_axis(vertices, triangles, count, name != "box", EDGES[edges])
    pieces = cut(mesh)
    output = distance.points_on_triangles(pieces, POINTS, np.random.default_rng(0))
    to_truth = shape.axis_distance(output @ matrix) / diagonal * 100
    to_output = distance.to_triangles(shape.axis_points(TRUTH) @ matrix.T, pieces) / diagonal * 100
    off_axis = shape.axis_distance(mesh.vertices @ matrix) / mesh.radius
    outside = int((shape.field(mesh.vertices @ matrix) > 0).sum())
    errors = [to_truth.mean(), np.quantile(to_truth, 0.99), to_truth.max()]
    errors += [to_output.mean(), to_output.max()]
    return (
        [name, turn, edges, str(samples), str(len(mesh.generators))]
        + [f"{x:.3f}" for x in errors]
        + [f"{off_axis.max():.2f}", str(outside)]
        + [str(x) for x in topology(mesh)]
    )


def points_of(mesh) -> cKDTree:
    return cKDTree(distance.points_on_triangles(cut(mesh), 20 * POINTS, np.random.default_rng(0)))


def fandisk_rows(path, count: int) -> list[list[str]]:
    vertices, triangles = meshes.read_off(path)
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    dense = points_of(inner_axis(vertices, triangles, 10 * count, False, EDGES["2 rows"])[1])
    rows = []
    for edges, options in EDGES.items():
        samples, mesh = inner_axis(vertices, triangles, count, False, options)
        here = points_of(mesh)
        there, back = (
            a.query(b.data[:POINTS])[0] / diagonal * 100 for a, b in ((dense, here), (here, dense))
        )
        winding = medial.winding_number(mesh.vertices, vertices, triangles)
        errors = [there.mean(), np.quantile(there, 0.99), there.max(), back.mean(), back.max()]
        rows.append(
            ["fandisk", "", edges, str(samples), str(len(mesh.generators))]
            + [f"{x:.3f}" for x in errors]
            + ["", str(int((winding <= 0.5).sum()))]
            + [str(x) for x in topology(mesh)]
        )
    return rows


def main(arguments: list[str]) -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--count", type=int, default=16000)
    options = parser.parse_args(arguments)
    rows = [
        exact_row(name, turn, edges, options.count)
        for name in NAMES
        for turn in ROTATIONS
        for edges in EDGES
    ]
    fandisk = _module.DATA / "fandisk_large.off"
    if fandisk.exists():
        rows += fandisk_rows(fandisk, options.count)
    _module.publish(_module.markdown(HEADER, rows), options.output)


if __name__ == "__main__":
    main(sys.argv[1:])
