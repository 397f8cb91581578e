# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges of polygons: against a dictionary, and what is refused."""

import itertools

import numpy as np
import pytest
from support.shapes import SHAPES


def by_hand(offsets, corners):
    """(e, 2) edges in order, and that of each corner."""
    sides = []
    for begin, end in itertools.pairwise(offsets):
        polygon = corners[begin:end].tolist()
        sides += [tuple(sorted(pair)) for pair in zip(polygon, polygon[1:] + polygon[:1])]
    edges = sorted(set(sides))
    number = {edge: row for row, edge in enumerate(edges)}
    return np.array(edges).reshape(-1, 2), np.array([number[side] for side in sides])


def arrays(*polygons):
    offsets = np.cumsum([0, *map(len, polygons)]).astype(np.int32)
    return offsets, np.array([v for polygon in polygons for v in polygon], np.int32)


@pytest.mark.parametrize(
    "polygons",
    [
        ((0, 1, 2), (2, 1, 3, 4)),
        ((5, 9, 7),),  # vertices without a face
        ((0, 1, 2), (0, 1, 2), (2, 1, 0)),  # in both directions, and again
        (),
    ],
)
def test_small(medial, polygons):
    offsets, corners = arrays(*polygons)
    edges, of_corner = medial.polygon_edges(offsets, corners, 10)
    for one, other in zip((edges, of_corner), by_hand(offsets, corners), strict=True):
        np.testing.assert_array_equal(one, other)
    assert edges.dtype == of_corner.dtype == np.int32


def test_of_a_medial_axis(medial):
    points = SHAPES["ellipsoid"].random_sample(3_000, 0)
    axis = medial.MedialAnalysis(points, sides=medial.SidesFrom.NONE).extract()
    found = medial.polygon_edges(axis.face_offsets, axis.face_vertices, len(axis.vertices))
    for one, other in zip(found, by_hand(axis.face_offsets, axis.face_vertices), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize(
    ("offsets", "corners", "found"),
    [
        ([0, 3], [0, 1, 9], "found 9"),
        ([0, 3], [0, 1, -1], "found -1"),
        ([1, 3], [0, 1, 2], "face_offsets that ascend"),
        ([0, 4, 3], [0, 1, 2], "face_offsets that ascend"),
        ([0, 3], [0, 1, 2, 3], "face_offsets that ascend"),
        ([], [], "face_offsets that ascend"),
    ],
)
def test_refused(medial, offsets, corners, found):
    with pytest.raises(medial.InvalidInputError, match=found):
        medial.polygon_edges(np.array(offsets, np.int32), np.array(corners, np.int32), 9)


@pytest.mark.parametrize("dtype", [np.int64, np.float64])
def test_other_types_are_refused(medial, dtype):
    offsets, corners = arrays((0, 1, 2))
    said = r"face_vertices as a contiguous \(m,\) int32 array"
    with pytest.raises(medial.InvalidInputError, match=said):
        medial.polygon_edges(offsets, corners.astype(dtype), 3)
