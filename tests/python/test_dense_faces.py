# SPDX-License-Identifier: GPL-3.0-or-later
"""Where samples on curved walls are very dense, vertices stay at the Voronoi diagram; on creases they never do."""

import medial_axis
import numpy as np
import pytest
from medial_axis.core.axis.medial_axis import ON_CREASE, VORONOI

MANY = 50_000  # kManySamples


def _turned(radius, height, around):
    """A solid of revolution by rings with (k,) radii and heights, between two poles where the radius is 0."""
    turn = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)
    rings = np.stack(
        [
            np.outer(radius[1:-1], np.cos(turn)),
            np.outer(radius[1:-1], np.sin(turn)),
            np.repeat(height[1:-1, None], around, axis=1),
        ],
        axis=2,
    ).reshape(-1, 3)
    points = np.concatenate([rings, [[0.0, 0.0, height[0]], [0.0, 0.0, height[-1]]]])
    own = np.arange(around)
    after = (own + 1) % around
    rows = [
        np.stack([first + own, first + after, first + around + after, first + around + own], axis=1)
        for first in range(0, (len(radius) - 3) * around, around)
    ]
    quads = np.concatenate(rows)
    low, high = len(rings), len(rings) + 1
    last = len(rings) - around
    caps = [
        np.stack([after, own, np.full(around, low)], axis=1),
        np.stack([last + own, last + after, np.full(around, high)], axis=1),
    ]
    return points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]], *caps])


def _oblate(rings, around):
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, rings)
    return _turned(np.cos(turn), 0.5 * np.sin(turn), around)


def _lens(rings, around):
    """Two caps of spheres that meet in a sharp edge of radius 1."""
    half = 0.5 * np.sqrt(np.linspace(0.0, 1.0, rings // 2))  # dense at the edge, as the rings are there
    height = np.concatenate([half - 0.5, 0.5 - half[-2::-1]])
    return _turned(np.sqrt(np.clip(1.5625 - (np.abs(height) + 0.75) ** 2, 0.0, None)), height, around)


def _made(mesh):
    """The axis, the placing of its vertices, and those of sheets."""
    axis = medial_axis.compute(*mesh, sampling="vertices").axis
    return axis, axis.level.place, np.unique(axis.face_vertices)


@pytest.mark.parametrize("rings, stays", [(128, True), (100, False)])
def test_vertices_between_dense_walls_stay(rings, stays):
    mesh = _oblate(rings, 420)
    assert (len(mesh[0]) >= MANY) is stays
    _, place, sheets = _made(mesh)
    assert np.mean(place[sheets] == VORONOI) == stays


def test_sheets_between_dense_walls_still_end_on_creases():
    axis, place, sheets = _made(_lens(200, 300))
    assert np.mean(place[sheets] == VORONOI) > 0.5
    on_crease = place == ON_CREASE
    assert np.count_nonzero(on_crease) == 300
    assert np.all(axis.radius[on_crease] == 0.0)
    assert np.hypot(*axis.vertices[on_crease, :2].T) == pytest.approx(1.0, abs=1e-6)
    near = np.hypot(*axis.vertices[sheets, :2].T) > 0.97
    assert not np.any(place[sheets[near]] == VORONOI)
