# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the inner cells that the samples alone cut off are no pieces; bodies of their own are, however small."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.settings import SamplingMode, Settings, SidesFrom
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from support import meshes, reference
from support.thick_meshes import TETRAHEDRON

pytestmark = pytest.mark.oracle


def wedge(degrees):
    """A prism over a triangle with two sides of length 1."""
    turn = np.radians(degrees)
    below = [[0, 0, 0], [1, 0, 0], [np.cos(turn), np.sin(turn), 0]]
    points = np.array(below + [[x, y, 1] for x, y, _ in below], float)
    # The seeds of the tests below find pockets where the sides are cut this way.
    triangles = [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]]
    return points, np.array([*triangles, [2, 0, 3], [2, 3, 5]], np.int32)


def circumcentres(points, cells):
    """(c, 3), far away where a cell is flat."""
    corners = points[cells] - points[cells[:, :1]]
    edges = corners[:, 1:]
    flat = np.abs(np.linalg.det(edges)) < 1e-15
    edges[flat] = np.eye(3)
    squares = (edges**2).sum(axis=2, keepdims=True)
    centres = np.linalg.solve(2 * edges, squares)[:, :, 0] + points[cells[:, 0]]
    centres[flat] = 1e6
    return centres


def parts(study, points, mesh):
    """How many parts the cells have whose circumcentres lie inside, joined through triangles: one by one."""
    cells = study.delaunay(points)[0]
    inner = reference.winding_number(circumcentres(points, cells), *mesh) > 0.5
    first, pairs = {}, []
    for cell in np.flatnonzero(inner):
        for triangle in combinations(sorted(cells[cell].tolist()), 3):
            pairs.append((first.setdefault(triangle, cell), cell))
    joined = coo_matrix((np.ones(len(pairs)), np.transpose(pairs)), shape=(len(cells),) * 2)
    return len(np.unique(connected_components(joined, directed=False)[1][inner]))


def analysed(medial, mesh, count=1500, **options):
    found = medial.sample_surface(*mesh, count=count, **options)
    return found, medial.MedialAnalysis(found.points, mesh[1], vertices=mesh[0])


@pytest.mark.parametrize("degrees, seed", [(25, 2), (25, 3), (35, 0), (50, 0)])
def test_a_wedge_is_one_piece(study, degrees, seed):
    mesh = wedge(degrees)
    found, analysis = analysed(study, mesh, seed=seed, mirrored_rows=0)
    assert parts(study, found.points, mesh) > 1  # what the samples make of its edge
    assert analysis.hierarchy().betti[0] == 1


def test_levels_have_the_topology_without_pockets(medial):
    hierarchy = analysed(medial, wedge(35), mirrored_rows=0)[1].hierarchy()
    for chosen in ({}, {"spacings": 1.0, "relaxed": True}, {"sheet": np.inf, "limb": np.inf}):
        level = hierarchy.extract(**chosen)
        assert tuple(level.betti) == (1, 0, 0) and len(level.points) == ("limb" in chosen)


def test_facets_as_published_stay(medial):
    """Every facet with all its Voronoi vertices inside is inner, in a pocket or not."""
    mesh = wedge(35)
    _, analysis = analysed(medial, mesh, mirrored_rows=0)
    published = analysis.extract(side=medial.Side.INNER)
    assert (reference.winding_number(published.vertices, *mesh) > 0.5).all()


BALL = meshes.icosphere(2)
CUBE = meshes.box((1, 1, 1), (0.5, 0.5, 0.5))


def bodies_seen(study, points, bodies, vertices):
    """In which bodies inner cells have their circumcentres, and in which places lie."""
    centres = circumcentres(points, study.delaunay(points)[0])
    cells = [(reference.winding_number(centres, *body) > 0.5).any() for body in bodies]
    return cells, [(reference.winding_number(vertices, *body) > 0.5).any() for body in bodies]


@pytest.mark.parametrize(
    "size, gap", [(1.0, 1e-6), (0.1, 1e-3), (0.01, 0.5), (0.01, 1e-6), (1e-4, 0.5)]
)
@pytest.mark.parametrize("body", [BALL, CUBE, wedge(60)], ids=["ball", "cube", "wedge"])
def test_no_body_is_lost(study, body, gap, size):
    """A body counts even if it is smaller and closer than the distance between samples, which are the vertices."""
    low = (size * body[0][:, 0]).min()
    other = meshes.moved(body, (BALL[0][:, 0].max() + gap - low, 0.0, 0.0), size)
    points, triangles = meshes.join(BALL, other)
    hierarchy = study.MedialAnalysis(points, triangles).hierarchy()
    cells, vertices = bodies_seen(study, points, (BALL, other), hierarchy.vertices)
    assert vertices == cells
    # Else cells lead from one to the other, across a gap that the samples do not show.
    if gap == 0.5:
        assert hierarchy.betti[0] == sum(cells) == 2


def test_a_body_of_four_samples_is_a_piece(medial):
    points, triangles = meshes.join(BALL, meshes.moved(TETRAHEDRON, (1.05, 0, 0), 0.02))
    analysis = medial.MedialAnalysis(points, triangles)
    assert analysis.hierarchy().betti[0] == analysis.hierarchy(bodies=2).betti[0] == 2
    assert analysis.hierarchy(bodies=1).betti == (1, 0, 0)
    settings = Settings(sampling=SamplingMode.VERTICES)
    assert compute(points, triangles, settings).axis.level.betti == (2, 0, 0)


@pytest.mark.parametrize("name, loops", [("elephant-with-holes.off", 3), ("engine_parts.ply", 24)])
def test_a_crumb_is_no_piece(data_file, name, loops):
    """The faces of one are open, those of the other are seven bodies."""
    settings = Settings(sampling=SamplingMode.VERTICES)
    if name == "elephant-with-holes.off":
        settings = replace(settings, sides=SidesFrom.TIGHT_COCONE)
    found = compute(*meshes.read(data_file(name)), settings)
    bodies = found.chosen.samples.by_faces
    betti = found.axis.level.betti
    assert betti == (1 if bodies is None else bodies[0], loops, 0)
    plain = found.chosen.samples.analysis.hierarchy().betti
    assert plain == (betti[0] + 1, loops, 0)


def test_parts_that_are_all_small_stay(medial):
    pair = meshes.join(TETRAHEDRON, meshes.moved(TETRAHEDRON, (9.0, 0, 0)))
    assert medial.MedialAnalysis(*pair).hierarchy(bodies=1).betti == (2, 0, 0)
    small = [meshes.moved(TETRAHEDRON, (x, 0, 0), 0.02) for x in (1.05, 2.0)]
    three = meshes.join(BALL, *small)
    for bodies in (1, 2):
        assert medial.MedialAnalysis(*three).hierarchy(bodies=bodies).betti == (bodies, 0, 0)


@pytest.mark.parametrize("size", [1.0, 0.2, 0.05])
def test_bodies_that_touch_in_an_edge_are_two(study, size):
    """Samples on the edge belong to both; no way through the solid leads from one to the other."""
    small = size * CUBE[0] + (0.5 + 0.5 * size, 0.5 + 0.5 * size, 0.0), CUBE[1]
    found, analysis = analysed(study, meshes.join(CUBE, small), 1000)
    vertices = analysis.hierarchy().vertices
    cells, vertices = bodies_seen(study, found.points, (CUBE, small), vertices)
    assert vertices == cells == [True, True]


def dumbbell(neck):
    x = np.linspace(-1.0, 1.0, 61)[1:-1]
    radius = np.maximum(0.4 * np.sqrt(np.maximum(0, 1 - ((np.abs(x) - 0.6) / 0.4) ** 2)), neck)
    return meshes.lathe(np.column_stack((radius, x)), 48)


def test_what_the_samples_can_tell_is_kept_beyond_a_neck_that_they_lose(medial):
    """Two large balls on a neck that few samples show are a part each, or one: none of them is a pocket."""
    mesh = dumbbell(0.004)
    places = analysed(medial, mesh)[1].hierarchy().extract(limb=0.0).vertices
    axis = int(np.argmax(np.ptp(mesh[0], axis=0)))
    assert places[:, axis].min() < -0.5 and places[:, axis].max() > 0.5


def test_pockets_at_the_rim_of_an_opening(medial):
    """Half a ball whose lid are samples: as one click makes it."""
    bowl = meshes.below(meshes.icosphere(4), 0.0)
    for seed in range(3):
        settings = Settings(sampling=SamplingMode.SURFACE, samples=1500, seed=seed)
        assert compute(*bowl, settings).axis.level.betti == (1, 0, 0)
