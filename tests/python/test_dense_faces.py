# SPDX-License-Identifier: GPL-3.0-or-later
"""Where samples on curved walls are very dense, vertices stay at the Voronoi diagram; on creases they never do."""

import medial_axis
import numpy as np
import pytest
from medial_axis.core.axis.medial_axis import ON_CREASE, VORONOI
from scipy.spatial import ConvexHull

MANY = 50_000  # kManySamples


def _turned(radius, height, around):
    """A convex solid of revolution by rings with (k,) radii and heights."""
    turn = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)
    round_axis = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    rings = [np.column_stack([r * round_axis, np.full(around, z)]) for r, z in zip(radius, height)]
    points = np.concatenate(rings)
    hull = ConvexHull(points, qhull_options="QJ")
    triangles = hull.simplices.astype(np.int32)
    a, b, c = points[triangles].transpose(1, 0, 2)
    inward = np.sum(np.cross(b - a, c - a) * a, axis=1) < 0.0
    return points, np.where(inward[:, None], triangles[:, ::-1], triangles)


def _oblate(rings, around):
    turn = np.linspace(-1.55, 1.55, rings)
    return _turned(np.cos(turn), 0.5 * np.sin(turn), around)


def _lens(rings, around):
    """Two caps of spheres that meet in a sharp edge of radius 1, where the rings are closest."""
    half = 0.5 * (1.0 - np.sqrt(np.linspace(0.001, 1.0, rings // 2)))
    height = np.concatenate([-half, half[-2::-1]])
    return _turned(np.sqrt(1.25**2 - (np.abs(height) + 0.75) ** 2), height, around)


def _made(mesh):
    """The axis, the placing of its vertices, and those of sheets."""
    axis = medial_axis.compute(*mesh, sampling="vertices", mesh="voronoi").axis
    return axis, axis.level.place, np.unique(axis.face_vertices)


@pytest.mark.parametrize("rings, stays", [(128, True), (100, False)])
def test_vertices_between_dense_walls_stay(rings, stays):
    mesh = _oblate(rings, 420)
    assert (len(mesh[0]) >= MANY) is stays
    axis, place, sheets = _made(mesh)
    # The poles are flat faces, between which a vertex may move.
    sheets = sheets[np.hypot(*axis.vertices[sheets].T[:2]) > 0.1]
    assert np.mean(place[sheets] == VORONOI) == stays


def test_sheets_between_dense_walls_still_end_on_creases():
    axis, place, sheets = _made(_lens(200, 300))
    assert np.mean(place[sheets] == VORONOI) > 0.5
    on_crease = place == ON_CREASE
    assert np.count_nonzero(on_crease) >= 300
    assert np.all(axis.radius[on_crease] == 0.0)
    away = np.hypot(*axis.vertices.T[:2])
    assert away[on_crease] == pytest.approx(1.0, abs=1e-4)
    assert not np.any(place[sheets[away[sheets] > 0.97]] == VORONOI)
