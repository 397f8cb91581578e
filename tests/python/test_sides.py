# SPDX-License-Identifier: GPL-3.0-or-later
"""A facet is inner exactly when all its Voronoi vertices have generalized winding number > 1/2: against brute force.

Only a facet with a vertex on the surface itself, where the winding number jumps, may differ.
"""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from support import distance, meshes, reference, topology
from support.messy import some_flipped

pytestmark = pytest.mark.oracle


def faces(mesh, rows):
    """The mesh with some of its faces, and all vertices."""
    return mesh[0], np.ascontiguousarray(mesh[1][rows])


def without_triangles(mesh, share, seed=0):
    return faces(mesh, np.random.default_rng(seed).random(len(mesh[1])) >= share)


def two_balls(subdivisions, radius, centre):
    return meshes.join(
        meshes.icosphere(subdivisions), meshes.icosphere(subdivisions, radius, centre)
    )


def noisy(mesh, amount=2e-3):
    return meshes.jitter(mesh, amount)


def with_loose_points(mesh, count=100):
    """Samples that no triangle uses, inside and outside."""
    extra = np.random.default_rng(5).uniform(-1.5, 1.5, (count, 3))
    return np.concatenate((mesh[0], extra)), mesh[1]


def sliver_tower():
    """A tall prism with vertices only at its ends: triangles longer than the spacing of samples by far."""
    return noisy(meshes.moved(meshes.box((3, 3, 1), (1.0, 1.0, 1.0)), scale=(0.2, 0.2, 3.0)), 1e-3)


CLOSED = {
    "sphere": noisy(meshes.icosphere(3)),
    "coarse sphere": noisy(meshes.icosphere(1)),
    "icosahedron": noisy(meshes.icosphere(0)),
    "exact icosphere": meshes.icosphere(2),
    "exact uv sphere": meshes.uv_sphere(24, 12),
    "ellipsoid": noisy(meshes.moved(meshes.icosphere(3), scale=(1.0, 0.6, 0.3))),
    "torus": noisy(meshes.torus()),
    "coarse torus": noisy(meshes.torus(around=9, across=5)),
    "box": meshes.box((10, 8, 5)),
    "noisy box": noisy(meshes.box((10, 8, 5))),
    "cube": meshes.box((1, 1, 1)),
    "noisy cube": noisy(meshes.box((1, 1, 1)), 0.05),
    "long triangles": sliver_tower(),
    "plate": noisy(meshes.moved(meshes.icosphere(2), scale=(1.0, 1.0, 0.01)), 1e-4),
    "nested shell": noisy(meshes.nested_shell(3)),
    "coarse nested shell": noisy(meshes.nested_shell(1)),
    "ball in a cavity": noisy(
        meshes.join(meshes.nested_shell(2), meshes.icosphere(2, 0.3, (0.1, 0.0, 0.0)))
    ),
    "two balls": noisy(two_balls(2, 0.5, (2.0, 0.1, 0.0))),
    "overlapping balls": noisy(two_balls(3, 0.8, (0.9, 0.1, 0.05))),
    "overlapping coarse balls": noisy(two_balls(1, 0.8, (0.9, 0.1, 0.05))),
    "linked tori": noisy(
        meshes.join(
            meshes.torus(small=0.25),
            (meshes.torus(small=0.25)[0][:, [0, 2, 1]] + (1.0, 0, 0), meshes.torus()[1][:, ::-1]),
        )
    ),
    "inside out": noisy(meshes.flip(meshes.icosphere(2))),
    "doubled ball": noisy(two_balls(2, 0.999, (1e-3, 0, 0))),
    "loose points": with_loose_points(noisy(meshes.icosphere(2))),
}
OPEN = {
    "flipped faces": some_flipped(noisy(meshes.icosphere(3)), 0.2),
    "one flipped face": some_flipped(noisy(meshes.torus()), 0.001, 3),
    "missing faces": without_triangles(noisy(meshes.icosphere(3)), 0.03),
    "half missing": without_triangles(noisy(meshes.torus()), 0.5),
    "bowl": noisy(meshes.below(meshes.icosphere(3), 0.3)),
    "box without lid": meshes.below(meshes.box((8, 6, 4)), 0.39),
    "one triangle": faces(noisy(meshes.icosphere(1)), [0]),
    "repeated face": faces(noisy(meshes.icosphere(2)), [*range(320), 0]),
}
ALL = CLOSED | OPEN


def analyse(medial, points, triangles, **options):
    return medial.MedialAnalysis(points, triangles, sides=medial.SidesFrom.SURFACE, **options)


def expected_sides(study, points, surface, analysis):
    """(e,) side by brute force, (6 c, 2) pairs of an edge and a cell of its ring, (c, 3) circumcentres."""
    cells, _, centres = study.delaunay(points)
    finite = (cells >= 0).all(axis=1)
    cells, centres = cells[finite], centres[finite]
    near = np.linalg.norm(centres - points.mean(axis=0), axis=1) < 1e3 * np.ptp(points)
    inside = np.zeros(len(cells), dtype=bool)
    inside[near] = reference.winding_number(centres[near], *surface) > 0.5
    row = {tuple(edge): i for i, edge in enumerate(analysis.edges.tolist())}
    count, inner = np.zeros(len(row), dtype=int), np.zeros(len(row), dtype=int)
    incident = []
    for i, j in ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)):
        edge = np.array([row[tuple(pair)] for pair in np.sort(cells[:, [i, j]], axis=1).tolist()])
        np.add.at(count, edge, 1)
        np.add.at(inner, edge, inside)
        incident.append(np.column_stack((edge, np.arange(len(cells)))))
    side = np.where(inner == 0, 2, np.where((inner == count) & analysis.bounded, 1, 3))
    return side, np.concatenate(incident), centres


@pytest.mark.parametrize("name", ALL)
def test_sides_equal_brute_force(study, name):
    """Where they differ, a Voronoi vertex of the facet lies on the surface, up to rounding."""
    points, triangles = ALL[name]
    analysis = analyse(study, points, triangles)
    wanted, incident, centres = expected_sides(study, points, ALL[name], analysis)
    wrong = np.flatnonzero(analysis.side != wanted)
    if len(wrong) == 0:
        return
    rows = incident[np.isin(incident[:, 0], wrong)]
    cells, where = np.unique(rows[:, 1], return_inverse=True)
    radius = cKDTree(points).query(centres[cells])[0]
    reach = 1e-6 * np.minimum(radius, np.ptp(points))
    on_surface = distance.to_triangles(centres[cells], points[triangles]) < reach
    excused = np.unique(rows[on_surface[where], 0])
    assert np.array_equal(excused, wrong)
    assert len(wrong) < 0.5 * len(wanted)


@pytest.mark.parametrize(
    "vertices, triangles, word",
    [
        (np.eye(3), np.array([[0, 1, 3]], np.int32), "below 3, found 3"),
        (np.eye(3)[:0], np.array([[0, 1, 2]], np.int32), "below 0, found 0"),
        (np.eye(3)[:, :2], np.array([[0, 1, 2]], np.int32), "vertices"),
        (np.eye(3).astype(int), np.array([[0, 1, 2]], np.int32), "vertices"),
        (np.diag([1, np.nan, 1]), np.array([[0, 1, 2]], np.int32), "row 1; .* vertex"),
        (np.diag([1, 1, np.inf]), np.array([[0, 1, 2]], np.int32), "row 2; .* vertex"),
    ],
    ids=["beyond", "none", "two columns", "int", "nan", "inf"],
)
def test_vertices_that_are_not_valid(medial, vertices, triangles, word):
    with pytest.raises(medial.InvalidInputError, match=rf"^Expected .*{word}"):
        medial.MedialAnalysis(ALL["sphere"][0], triangles, vertices=vertices)


@pytest.mark.parametrize("name", ALL)
def test_closed_and_boundary_edges(medial, name):
    points, triangles = ALL[name]
    analysis = analyse(medial, points, triangles)
    assert analysis.boundary_edges == topology.boundary_edges(triangles)
    assert analysis.closed == (name in CLOSED)


def test_when_nothing_tells_no_side_is_known(medial):
    points, triangles = ALL["sphere"]
    for faces in (None, triangles[:0], triangles):
        analysis = medial.MedialAnalysis(points, faces, sides=medial.SidesFrom.NONE)
        assert (analysis.side == 0).all() and (analysis.extract(0.0, 0.0).side == 0).all()
        assert analysis.closed == (faces is triangles) and analysis.boundary_edges == 0
