# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface as the samples see it, and the parts of a surface that are no boundary of its solid."""

import numpy as np
import pytest
from support import meshes, reference, topology
from support.shapes import SHAPES

pytestmark = pytest.mark.oracle

BALL = meshes.jitter(meshes.icosphere(3), 1e-3)


def boundary(cells, neighbors, inner):
    """Sorted triangles, lowest row first, between inner cells and others, outward; by the definition."""
    found = []
    for slot, face in enumerate(((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))):
        rows = np.flatnonzero(inner & ~inner[neighbors[:, slot]])
        found.append(cells[rows][:, face])
    found = np.concatenate(found)
    first = found.argmin(axis=1)[:, None]
    found = np.take_along_axis(found, (first + np.arange(3)) % 3, axis=1)
    return found[np.lexsort(found.T[::-1])]


def expected(study, points, inside):
    cells, neighbors, centres = study.delaunay(points)
    inner = (cells >= 0).all(axis=1)
    inner[inner] = inside(centres[inner])
    return boundary(cells, neighbors, inner)


@pytest.mark.parametrize("name", ["ellipsoid", "torus", "slab", "knot"])
def test_tight_cocone_gives_its_watertight_surface(medial, name):
    points = SHAPES[name].random_sample(3000, 1)
    alone = medial.TightCocone(points).triangles
    assert len(alone) > 4000
    analysis = medial.MedialAnalysis(points, sides=medial.SidesFrom.TIGHT_COCONE)
    assert np.array_equal(analysis.solid_triangles(), alone)


MESHES = {
    "ball": BALL,
    "torus": meshes.jitter(meshes.torus(), 1e-3),
    "shell": meshes.jitter(meshes.nested_shell(3), 1e-4),
    "box": meshes.jitter(meshes.box((10, 8, 5)), 1e-3),
}


@pytest.mark.parametrize("sphere", [False, True])
@pytest.mark.parametrize("name", MESHES)
def test_triangles_of_a_surface(study, name, sphere):
    """Between the cells whose Voronoi vertex is inside and the others; with a bounding sphere the same."""
    points, triangles = MESHES[name]
    analysis = study.MedialAnalysis(points, triangles, bounding_sphere=sphere)
    inside = lambda x: reference.winding_number(x, points, triangles) > 0.5
    found = analysis.solid_triangles()
    assert np.array_equal(found, expected(study, points, inside))
    assert found.dtype == np.int32 and topology.is_oriented(found)
    assert topology.volume(points, found) == pytest.approx(topology.volume(points, triangles), 0.02)


def test_triangles_by_normals(medial):
    shape = SHAPES["ellipsoid"]
    points = shape.sample(3000, 1)
    found = medial.MedialAnalysis(points, normals=shape.normals(points)).solid_triangles()
    assert topology.is_oriented(found) and topology.euler(found) == 2
    volume = 4 / 3 * np.pi * shape.a * shape.b * shape.c
    assert topology.volume(points, found) == pytest.approx(volume, 0.01)


def test_the_surface_as_separate_samples_see_it(medial):
    """A mesh with vertices of its own: the triangles are rows of the samples."""
    shape = SHAPES["torus"]
    vertices, triangles = meshes.torus(around=90, across=40)
    points = shape.sample(4000, 1)
    found = medial.MedialAnalysis(points, triangles, vertices=vertices).solid_triangles()
    assert topology.is_oriented(found) and found.max() < len(points)
    volume = 2 * np.pi**2 * shape.big * shape.small**2
    assert topology.volume(points, found) == pytest.approx(volume, 0.02)


def test_no_sides_no_solid(medial):
    analysis = medial.MedialAnalysis(BALL[0], sides=medial.SidesFrom.NONE)
    with pytest.raises(medial.InvalidInputError, match=r"^Expected .*found.*NONE; choose"):
        analysis.solid_triangles()


def centres_and_normals(mesh):
    return mesh[0][mesh[1]].mean(axis=1), topology.unit_normals(*mesh)


SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float) - (0.5, 0.5, 0)
SHEET = SQUARE, np.array([[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]], np.int32)
OPENED = meshes.below(BALL, 0.7)
SOUPS = {
    "ball": BALL,
    "inside out": meshes.flip(BALL),
    "shell": MESHES["shell"],
    "overlapping": meshes.join(BALL, meshes.moved(BALL, (0.9, 0.1, 0.05))),
    "three": meshes.join(
        BALL, meshes.moved(BALL, (0.9, 0.1, 0.05)), meshes.moved(BALL, (0.2, 0.9, 0.1))
    ),
    "ball in a ball": meshes.join(BALL, (0.4 * BALL[0], BALL[1])),
    "wall inside": meshes.join(meshes.box((6, 6, 6), (1.0, 1.0, 1.0)), SHEET),
    "sheet": SHEET,
    "bowl": meshes.below(BALL, 0.0),
    "ball that looks out of an open one": meshes.join(OPENED, (0.6 * OPENED[0], OPENED[1])),
}


@pytest.mark.parametrize("name", SOUPS)
def test_buried_equals_brute_force(medial, name):
    points, normals = centres_and_normals(SOUPS[name])
    offset = 1e-3
    found = medial.buried(points, normals, offset, *SOUPS[name])
    above, below = (
        reference.winding_number(points + s * offset * normals, *SOUPS[name]) > 0.5 for s in (1, -1)
    )
    assert found.dtype == bool and np.array_equal(found, above == below)


def test_only_the_wall_inside_is_buried(medial):
    points, normals = centres_and_normals(SOUPS["wall inside"])
    found = medial.buried(points, normals, 1e-3, *SOUPS["wall inside"])
    assert np.array_equal(np.flatnonzero(found), np.arange(len(points) - 4, len(points)))


def test_buried_at_vertices_and_edges(medial):
    """Where steps off the surface pass through corners; order, threads and repeated rows change nothing."""
    mesh = SOUPS["overlapping"]
    centre = np.where((np.arange(len(mesh[0])) < len(BALL[0]))[:, None], 0.0, (0.9, 0.1, 0.05))
    normals = mesh[0] - centre
    points = np.concatenate((mesh[0], mesh[0]))
    normals = np.concatenate((normals, -normals))
    found = medial.buried(points, normals, 1e-3, *mesh)
    other = np.where(centre[:, :1] == 0, (0.9, 0.1, 0.05), 0.0)
    depth = 1 - np.linalg.norm(mesh[0] - other, axis=1)
    clear = np.tile(np.abs(depth) > 0.02, 2)
    assert np.array_equal(found[clear], np.tile(depth > 0, 2)[clear]) and found.sum() > 100
    every = np.arange(len(points))
    for rows, threads in ((np.random.default_rng(0).permutation(every), 1), (every, 3)):
        again = medial.buried(points[rows], normals[rows], 1e-3, *mesh, threads=threads)
        assert np.array_equal(again, found[rows])


POINTS, NORMALS = centres_and_normals(BALL)


@pytest.mark.parametrize(
    "arguments, word",
    [
        ((POINTS, NORMALS[1:], 1e-3, *BALL), "one normal per point"),
        ((POINTS, NORMALS, 0.0, *BALL), "positive offset"),
        ((POINTS, NORMALS, -1.0, *BALL), "positive offset"),
        ((POINTS, NORMALS, np.nan, *BALL), "positive offset"),
        ((POINTS, NORMALS, np.inf, *BALL), "positive offset"),
        ((POINTS * np.nan, NORMALS, 1e-3, *BALL), "finite coordinates.* point"),
        ((POINTS, NORMALS * np.inf, 1e-3, *BALL), "finite coordinates.* normal"),
        ((POINTS, NORMALS, 1e-3, BALL[0] * np.nan, BALL[1]), "finite coordinates.* vertex"),
        ((POINTS, NORMALS, 1e-3, BALL[0][:-1], BALL[1]), "triangle corners below"),
        ((POINTS[:, :2], NORMALS, 1e-3, *BALL), "points as"),
        ((POINTS, NORMALS[:, :2], 1e-3, *BALL), "normals as"),
        ((POINTS, NORMALS, 1e-3, BALL[0][:, :2], BALL[1]), "vertices as"),
        ((POINTS, NORMALS, 1e-3, BALL[0], BALL[1].astype(float)), "triangles as"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_buried_checks_its_input(medial, arguments, word):
    patterns = rf"Expected .*{word}.*found.+;", rf"Expected finite.*found.*;.*{word.split()[-1]}"
    with pytest.raises(medial.InvalidInputError, match=f"^({'|'.join(patterns)})"):
        medial.buried(*arguments)
