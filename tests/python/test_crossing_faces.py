# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that pass through each other: which pairs, against a test in floating point, and what is said of them."""

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from medial_axis import library
from medial_axis.core.machine import native
from support import meshes
from support.crossing_triangles import crossing_pairs
from support.swept import swept

RIGHT = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])


def crossing(points, triangles, **options):
    shape = meshes.shape_of((points, triangles))
    return native.load().crossing_faces(shape.points, shape.triangles, **options)


def soup(*corners):
    return np.concatenate(corners), np.arange(3 * len(corners)).reshape(-1, 3)


def rope(apart, rings=60, sides=12):
    """A closed tube of radius 0.1 that lies across itself; its axis passes itself at a distance."""
    u = np.linspace(-1.15, 1.15, rings)
    line = np.column_stack((u**3 - u, u**2, apart * u / 2))
    along = np.gradient(line, axis=0)
    side = np.cross(along, (0, 0, 1))
    side /= np.linalg.norm(side, axis=1)[:, None]
    up = np.cross(along / np.linalg.norm(along, axis=1)[:, None], side)
    return swept(line, 0.1 * side, 0.1 * up, sides)


@pytest.mark.parametrize("seed", range(3))
def test_a_soup_crosses_as_in_floating_point(seed):
    rng = np.random.default_rng(seed)
    points = (rng.random((300, 1, 3)) + 0.2 * rng.normal(size=(300, 3, 3))).reshape(-1, 3)
    triangles = np.arange(900).reshape(-1, 3)
    found = crossing(points, triangles)
    assert len(found) > 500 and np.array_equal(found, crossing_pairs(points, triangles))
    assert np.array_equal(crossing(points * 2.0**-40, triangles), found)


def test_what_touches_does_not_cross():
    lower = meshes.box((1, 1, 1))
    stacked = meshes.join(lower, meshes.moved(lower, (0.3, 0.4, 0.8)))
    assert len(crossing(*stacked)) == 0, "a box that stands on another one"
    standing = soup(RIGHT, [[0.2, 0.2, 0], [0.3, 0.3, 1], [0.2, 0.3, 1]])
    assert len(crossing(*standing)) == 0, "a corner on a triangle"
    through = soup(RIGHT, [[0.2, 0.2, -1e-300], [0.3, 0.3, 1], [0.2, 0.3, 1]])
    assert crossing(*through).tolist() == [[0, 1]], "decided exactly"


def test_faces_with_a_common_corner_may_cross():
    points = np.array([*RIGHT, [0.5, 0.2, 1], [0.5, 0.2, -1]])
    assert crossing(points, [[0, 1, 2], [0, 3, 4]]).tolist() == [[0, 1]]
    assert crossing(points, [[0, 1, 2], [1, 2, 3]]).tolist() == []


def test_the_search_ends_where_it_is_told_to():
    needle = np.array([[0, 0, 0.5], [0, 0, -0.5], [0.01, 0, -0.5]])
    places = 0.1 + 0.3 * np.random.default_rng(1).random((50, 3)) * (1, 1, 0)
    points, triangles = soup(RIGHT, *(needle + place for place in places))
    assert {*map(tuple, crossing(points, triangles))} >= {(0, i) for i in range(1, 51)}
    some = crossing(points, triangles, most=20)
    assert 0 < len(some) <= 20 and len(crossing(points, triangles, most=0)) == 0


def test_a_rope_across_itself_is_named():
    """Its faces are a sphere, and the solid that they bound has a loop: the faces are at fault, and not the samples."""
    points, triangles = rope(0.19)
    found = library.compute(points, triangles, side="inner")
    assert found.axis.level.betti == (1, 1, 0)
    assert found.topology.endswith("no loop, no cavity: faces pass through each other")
    (told,) = (text for text in found.warnings if "pass through each other" in text)
    assert told.startswith(f"{len(crossing(points, triangles))} pairs of faces pass")
    assert not any("Budget" in text for text in found.warnings), "more samples do not help"


def test_a_rope_beside_itself_is_right():
    points, triangles = rope(0.25)
    found = library.compute(points, triangles, side="inner")
    assert found.topology == "1 piece, no loop, no cavity, as the solid" and not found.warnings


def side_of(a, b, c, d):
    """The side of the plane through a, b and c on which d lies, of exact fractions."""
    u, v, w = (np.array([Fraction(x) for x in p]) - [Fraction(x) for x in a] for p in (b, c, d))
    found = np.dot(u, np.cross(v, w))
    return (found > 0) - (found < 0)


def pierces(p, q, corners):
    side = side_of(*corners, p)
    if side == 0 or side_of(*corners, q) != -side:
        return False
    turns = {side_of(p, q, corners[i], corners[(i + 1) % 3]) for i in range(3)}
    return len(turns) == 1 and 0 not in turns


@pytest.mark.parametrize("off", [0.0, 1e-16, 1e-15], ids=["coplanar", "rounded", "farther"])
def test_triangles_of_nearly_one_plane_are_told_exactly(off):
    """Corners on a coarse grid, in a plane that is turned exactly, or where only the last digits decide."""
    rng = np.random.default_rng(5)
    x, y = rng.integers(-30, 31, (2, 120)) / 32.0
    points = np.column_stack((x, y, (3 * x - 2 * y) / 4)) + off * rng.integers(-2, 3, (120, 3))
    corners = points.reshape(-1, 3, 3)
    expected = [
        (i, j)
        for i, j in combinations(range(len(corners)), 2)
        if any(
            pierces(one[k], one[(k + 1) % 3], other)
            for one, other in ((corners[i], corners[j]), (corners[j], corners[i]))
            for k in range(3)
        )
    ]
    found = crossing(points, np.arange(120).reshape(-1, 3))
    assert list(map(tuple, found.tolist())) == expected
    assert bool(expected) == bool(off)
