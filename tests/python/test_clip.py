# SPDX-License-Identifier: GPL-3.0-or-later
"""The axis within a box: each facet judged by Qhull, its radii by the samples, and neighbours that stay joined."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from medial_axis.core.axis.clip import within_box
from medial_axis.core.axis.medial_axis import MedialAxis
from medial_axis.core.machine import native
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError
from support.measure import polygons
from support.meshes import icosphere


@pytest.fixture(scope="module")
def outer():
    """The whole outer axis of an ellipsoid without symmetry, and its samples."""
    points = icosphere(3)[0] @ np.array(((1.0, 0.1, 0.0), (0.0, 0.7, 0.2), (0.1, 0.0, 0.5)))
    module = native.load()
    analysis = module.MedialAnalysis(points, icosphere(3)[1], bounding_sphere=True)
    mesh = analysis.extract(side=module.Side.OUTER, theta=0.0, rho=0.0)
    names = MedialAxis.__dataclass_fields__
    return MedialAxis(**{n: getattr(mesh, n) for n in names if hasattr(mesh, n)}), points


def box_of(points):
    return points.min(axis=0), points.max(axis=0)


def free_edges(axis):
    """The edges of one facet only, by the places of their ends."""
    edges = Counter()
    for facet in polygons(axis):
        corners = list(map(tuple, axis.vertices[facet].tolist()))
        sides = zip(corners, corners[1:] + corners[:1], strict=True)
        edges.update(tuple(sorted(side)) for side in sides)
    return {edge for edge, times in edges.items() if times == 1}


def area(corners):
    """The area of a polygon, as half the sum of its crosses."""
    away = corners - corners[0]
    return np.linalg.norm(np.cross(away[:-1], away[1:]).sum(axis=0)) / 2


def area_within(corners, low, high):
    """The area of a convex polygon in a box, as Qhull finds it in the plane of the polygon."""
    _base, _, across = np.linalg.svd(corners - corners.mean(axis=0), full_matrices=False)
    frame = across[:2]
    flat = (corners - corners[0]) @ frame.T
    walls = [
        (s * frame[:, k], s * (corners[0, k] - w[k]))
        for k in range(3)
        for s, w in ((1, high), (-1, low))
    ]
    sides = np.array([*ConvexHull(flat).equations, *(np.append(n, d) for n, d in walls)])
    sides = sides[np.linalg.norm(sides[:, :2], axis=1) > 1e-12]
    # The largest circle within the half-planes.
    rows = np.column_stack((sides[:, :2], np.linalg.norm(sides[:, :2], axis=1)))
    bounds = [(None, None)] * 2 + [(0, None)]
    circle = linprog((0, 0, -1), rows, -sides[:, 2], bounds=bounds)
    if not circle.success or circle.x[2] <= 1e-9:
        return 0.0
    return ConvexHull(HalfspaceIntersection(sides, circle.x[:2]).intersections).volume


def test_what_is_left_of_each_facet_is_what_qhull_finds(outer):
    axis, points = outer
    left = within_box(axis, *box_of(points), 1.2)
    middle = sum(box_of(points)) / 2
    low, high = (middle + 1.2 * (side - middle) for side in box_of(points))
    mine = Counter()
    for generators, facet in zip(left.generators.tolist(), polygons(left), strict=True):
        mine[tuple(generators)] += area(left.vertices[facet])
    cut = 0
    for generators, facet in zip(axis.generators.tolist(), polygons(axis), strict=True):
        corners = axis.vertices[facet]
        try:
            whole = area_within(corners, low, high)
        except QhullError:  # a facet of no area
            continue
        assert mine[tuple(generators)] == pytest.approx(whole, rel=1e-6, abs=1e-8)
        cut += 0.0 < whole < 0.999 * area(corners)
    assert cut > 50


def test_balls_of_new_vertices_touch_the_samples(outer):
    axis, points = outer
    left = within_box(axis, *box_of(points), 1.2)
    samples = points[np.repeat(left.generators[:, 0], np.diff(left.face_offsets))]
    far = np.linalg.norm(left.vertices[left.face_vertices] - samples, axis=1)
    np.testing.assert_allclose(left.radius[left.face_vertices], far, rtol=1e-9)


def test_neighbours_stay_joined_and_the_cut_is_on_the_box(outer):
    """An edge that was shared is shared, and edges that became free lie in a side of the box."""
    axis, points = outer
    left = within_box(axis, *box_of(points), 1.2)
    assert len(np.unique(left.vertices, axis=0)) == len(left.vertices)
    high = 1.2 * (box_of(points)[1] - box_of(points)[0]) / 2
    away = np.abs(left.vertices - sum(box_of(points)) / 2)
    assert (away <= high * (1 + 1e-15)).all()
    on_side = np.isclose(away, high, rtol=1e-15)
    before = free_edges(axis)
    free = free_edges(left) - before
    side = {tuple(place): row for place, row in zip(left.vertices.tolist(), on_side, strict=True)}
    assert len(free) > 100
    # A new edge of the rim is on the box, or it is the rest of one that was free.
    rests = [edge for edge in free if not (side[edge[0]] & side[edge[1]]).any()]
    assert len(rests) < len(before) and all(side[a].any() != side[b].any() for a, b in rests)


def test_what_lies_within_stays_as_it_is(outer):
    axis, points = outer
    assert within_box(axis, *box_of(points), 0.0) is axis
    assert within_box(axis, *box_of(points), 1e6) is axis
    none = within_box(replace(axis, vertices=axis.vertices + 1e9), *box_of(points), 1.0)
    assert none.facets == len(none.vertices) == 0
