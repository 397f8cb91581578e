# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of an axis, judged by SciPy; and what is left when small or far ones go."""

from dataclasses import replace

import numpy as np
import pytest
import test_export
from medial_axis.core.axis import cut
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


def axis_of(points, polygons):
    """A medial axis of these polygons, whose theta numbers the facets."""
    return replace(test_export.axis_of(points, polygons), theta=np.arange(float(len(polygons))))


def random_axis(seed, vertices=300, count=50):
    rng = np.random.default_rng(seed)
    polygons = [rng.choice(vertices, rng.integers(3, 6), replace=False) for _ in range(count)]
    return axis_of(rng.normal(size=(vertices, 3)), polygons)


def judged(axis):
    """Labels of the facets by SciPy."""
    facets = np.repeat(np.arange(axis.facets), np.diff(axis.face_offsets))
    size = axis.facets + len(axis.vertices)
    links = (np.ones(len(facets)), (facets, axis.facets + axis.face_vertices))
    _, labels = connected_components(coo_matrix(links, (size, size)), directed=False)
    return labels[: axis.facets]


@pytest.mark.parametrize("seed", range(8))
def test_pieces_are_those_of_scipy_the_largest_first(seed):
    axis = random_axis(seed)
    mine, other = cut.pieces(axis), judged(axis)
    assert len(set(zip(mine.tolist(), other.tolist(), strict=True))) == len(set(mine.tolist()))
    assert len(set(mine.tolist())) == len(set(other.tolist())) > 1
    counts = np.bincount(mine)
    assert (np.diff(counts) <= 0).all() and counts.min() > 0


def test_a_long_strip_is_one_piece_however_it_is_numbered():
    rows = np.random.default_rng(3).permutation(2002)
    strip = [rows[[2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2]] for i in range(1000)]
    axis = axis_of(np.random.default_rng(4).normal(size=(2002, 3)), strip)
    assert (cut.pieces(axis) == 0).all()


def test_small_pieces_go_and_the_largest_always_stays():
    axis = random_axis(1)
    counts = np.bincount(cut.pieces(axis))
    assert cut.without_small_pieces(axis, 0.0) is axis
    left = cut.without_small_pieces(axis, counts[0] / axis.facets)
    assert left.facets == counts[counts == counts[0]].sum()
    assert cut.without_small_pieces(axis, 1.0).facets == counts[0]


def test_what_stays_is_as_it_was():
    axis = random_axis(2)
    keep = np.random.default_rng(5).random(axis.facets) < 0.4
    left = cut.with_facets(axis, keep)
    rows = np.flatnonzero(keep)
    assert left.facets == len(rows) and len(np.unique(left.face_vertices)) == len(left.vertices)
    for new, old in enumerate(rows):
        mine = left.face_vertices[slice(*left.face_offsets[new : new + 2])]
        whole = axis.face_vertices[slice(*axis.face_offsets[old : old + 2])]
        np.testing.assert_array_equal(left.vertices[mine], axis.vertices[whole])
        np.testing.assert_array_equal(left.radius[mine], axis.radius[whole])
    for name in ("theta", "rho", "side", "generators"):
        np.testing.assert_array_equal(getattr(left, name), getattr(axis, name)[rows])


# --- shards


def strips(*lengths, side=2):
    """Triangles of these lengths along X, far from each other, with balls of radius 1."""
    points = [
        p for k, x in enumerate(lengths) for p in ((0, 9 * k, 0), (x, 9 * k, 0), (x, 9 * k, 0.1))
    ]
    axis = axis_of(points, np.arange(len(points)).reshape(-1, 3))
    return replace(axis, radius=np.ones(len(points)), side=np.full(len(lengths), side, np.int32))


def test_outer_pieces_smaller_than_their_balls_go():
    axis = strips(30.0, 1.9, 2.1, 0.1)
    assert cut.without_shards(axis, 1.0).theta.tolist() == [0.0, 2.0]
    assert cut.without_shards(axis, 0.5).theta.tolist() == [0.0, 1.0, 2.0]
    assert cut.without_shards(axis, 0.0) is axis
    huge = replace(axis, vertices=1e200 * axis.vertices, radius=1e200 * axis.radius)
    assert cut.without_shards(huge, 1.0).theta.tolist() == [0.0, 2.0]


def test_inner_pieces_and_the_largest_stay():
    inner = strips(30.0, 0.1, side=1)
    assert cut.without_shards(inner, 1.0) is inner
    mixed = replace(strips(30.0, 0.1, 0.1), side=np.array((2, 1, 2), np.int32))
    assert cut.without_shards(mixed, 1.0).theta.tolist() == [0.0, 1.0]
    assert cut.without_shards(strips(0.1, 0.1), 1.0).facets == 1


def test_balls_without_a_radius_are_no_reason_to_drop_a_piece():
    axis = replace(strips(30.0, 1.0, 1.0), radius=np.repeat((1.0, 0.0, np.inf), 3))
    assert cut.without_shards(axis, 1.0).theta.tolist() == [0.0, 1.0]
