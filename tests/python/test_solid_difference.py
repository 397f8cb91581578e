# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances between surfaces, and between solids: what can be said by hand, and points on the triangles."""

import numpy as np
import pytest
from medial_axis.core.errors import InvalidInputError
from medial_axis.core.rebuild.solid_difference import solid_difference
from medial_axis.core.shape.shape import Shape
from support.meshes import join
from support.thick_meshes import block

CORNERS, FACES = block(1.0, 1.0, 1.0, (0.5, 0.5, 0.5))


def box(size=1.0):
    """A cube round the middle of the unit cube, outward."""
    return Shape(*block(size, size, size, (0.5, 0.5, 0.5)))


def to_box(points):
    """How far points are from the surface of the unit cube."""
    outside = np.linalg.norm(np.maximum(np.abs(points - 0.5) - 0.5, 0.0), axis=1)
    inside = np.minimum(points, 1 - points).min(axis=1)
    return np.where(outside > 0, outside, inside)


def by_sampling(query, corners, steps=60):
    """The distance to one triangle, at points of a fine grid on it: never less, and little more."""
    s, t = np.meshgrid(np.linspace(0, 1, steps), np.linspace(0, 1, steps))
    s, t = s[s + t <= 1], t[s + t <= 1]
    a, b, c = corners
    on_it = a + s[:, None] * (b - a) + t[:, None] * (c - a)
    return np.linalg.norm(on_it - query, axis=1).min()


def test_distances_to_a_box(medial):
    queries = np.random.default_rng(1).uniform(-1, 2, (5000, 3))
    found = medial.TriangleTree(CORNERS, FACES).distances(queries)
    assert np.allclose(found, to_box(queries), rtol=0, atol=1e-14)


def test_the_nearest_of_many_triangles(medial):
    random = np.random.default_rng(2)
    vertices = random.normal(size=(120, 3))
    triangles = random.integers(0, 120, (40, 3)).astype(np.int32)  # some without area
    queries = random.normal(size=(30, 3))
    found = medial.TriangleTree(vertices, triangles).distances(queries)
    for query, distance in zip(queries, found, strict=True):
        sampled = min(by_sampling(query, vertices[row]) for row in triangles)
        assert distance - 1e-12 <= sampled < distance + 0.1


def test_triangles_without_area_are_segments_and_points(medial):
    vertices = np.array([(0.0, 0, 0), (1, 0, 0), (2, 0, 0), (5, 0, 0)])
    triangles = np.array([(0, 1, 2), (3, 3, 3)], np.int32)
    queries = np.array([(0.5, 3, 0), (-3, 4, 0), (5, 0, 2), (1.5, 0, 0)])
    assert medial.TriangleTree(vertices, triangles).distances(queries).tolist() == [3, 5, 2, 0]


@pytest.mark.parametrize(
    ("queries", "triangles", "match"),
    [
        ([(np.nan, 0, 0)], FACES, "finite"),
        ([(0.0, 0, 0)], np.array([(0, 1, 8)], np.int32), "8"),
        ([(0.0, 0, 0)], np.zeros((0, 3), np.int32), "at least one triangle"),
    ],
)
def test_what_is_refused(medial, queries, triangles, match):
    with pytest.raises(medial.InvalidInputError, match=match):
        medial.TriangleTree(CORNERS, triangles).distances(np.array(queries, float))


def test_a_solid_does_not_differ_from_itself(medial):
    found = solid_difference(box(), box())
    assert found.mean < 1e-15 and found.largest < 1e-15 and found.volume == 1.0


def test_a_smaller_box(medial):
    """Faces a tenth inside: that is the distance everywhere from the inner, and at its corners from the outer one."""
    found = solid_difference(box(), box(0.8))
    assert found.volume == pytest.approx(0.512)
    assert found.largest == pytest.approx(0.1)  # a corner is sqrt(3) / 10 from the other corner
    assert found.mean >= 0.1 / np.sqrt(3)


def test_a_part_that_is_missing_counts_whichever_way_it_is_asked(medial):
    """Two cubes are compared with one: only the distance from the second cube is large."""
    one, two = box(), Shape(*join((CORNERS, FACES), (CORNERS + 3.0, FACES)))
    lost, added = solid_difference(two, one), solid_difference(one, two)
    assert lost.largest * 4 == pytest.approx(added.largest)
    assert lost.volume == 0.5 and added.volume == 2.0
    assert added.largest == pytest.approx(3.0)  # corner to corner


def test_without_faces_or_volume_nothing_is_said(medial):
    cloud = Shape(CORNERS, np.zeros((0, 3), np.int32))
    flat = Shape(CORNERS[:4], np.array([(0, 1, 2), (2, 1, 0)], np.int32))
    for first, second in ((cloud, box()), (box(), cloud), (flat, box())):
        with pytest.raises(InvalidInputError, match="found one without"):
            solid_difference(first, second)
