# SPDX-License-Identifier: GPL-3.0-or-later
"""The exact axes that everything else is judged by: against tangent balls, formulas in closed form, and meshes.

A tangent ball at a point of the surface grows inward as long as the shape's depth at its centre is its radius; the
depth knows nothing of the axis. The largest ones have their centres on the axis, and all of it.
"""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from support import distance, meshes, topology
from support.shape_meshes import MESHED, SHARP
from support.shapes import MORE_SHAPES, SHAPES

pytestmark = pytest.mark.oracle

ALL = SHAPES | MORE_SHAPES
BALLS = [name for name in ALL if name != "knot"]  # the knot's distance takes a minute a round


def largest_tangent_balls(shape, points):
    """Centres and radii, by bisection."""
    normals = shape.normals(points)
    low, high = np.zeros(len(points)), np.full(len(points), np.ptp(points))
    for _ in range(32):
        middle = 0.5 * (low + high)
        free = -shape.field(points - middle[:, None] * normals) > middle * (1 - 1e-8)
        low, high = np.where(free, middle, low), np.where(free, high, middle)
    return points - low[:, None] * normals, low


def off_edges(name, points):
    """The points with a unique normal: on a sharp edge the numerical slope is a mixture of two."""
    if name not in SHARP:
        return points
    shape, steps = ALL[name], 1e-4 * np.eye(3)
    normals = shape.normals(points)
    turned = [shape.normals(points + step - np.sum(step * normals, axis=1)[:, None] * normals)
              for step in steps]  # fmt: skip
    return points[np.max([np.linalg.norm(n - normals, axis=1) for n in turned], axis=0) < 1e-2]


@pytest.mark.parametrize("name", BALLS)
def test_largest_tangent_balls_are_centred_on_the_axis(name):
    shape = ALL[name]
    points = off_edges(name, shape.random_sample(1000, 1))
    centres, radii = largest_tangent_balls(shape, points)
    assert len(points) > 950
    assert shape.axis_distance(centres).max() < 1e-3
    assert np.abs(shape.axis_radius(centres) - radii).max() < 1e-3


@pytest.mark.parametrize("name", ALL)
def test_axis_points_lie_on_the_axis(name):
    shape = ALL[name]
    points = np.concatenate((shape.axis_points(500, 3), shape.rim_points(40)))
    assert shape.axis_distance(points).max() < 1e-7 and shape.inside(points).all()


@pytest.mark.parametrize("name", BALLS)
def test_tangent_balls_cover_the_axis(name):
    """No axis point without a ball near by: the truth claims nothing that is not there."""
    shape = ALL[name]
    centres, _ = largest_tangent_balls(shape, off_edges(name, shape.random_sample(8000, 2)))
    gap, _ = cKDTree(centres).query(shape.axis_points(1000, 4))
    assert np.quantile(gap, 0.99) < 0.08 and gap.max() < 0.2


@pytest.mark.parametrize("name", BALLS)
def test_depth_is_the_distance_to_the_surface(name):
    """The radius formulas lean on it: against samples as dense as can be, at points of the axis."""
    shape = ALL[name]
    points = shape.axis_points(300, 5)
    surface = shape.random_sample(200_000, 6)
    nearest, _ = cKDTree(surface).query(points)
    depth = shape.axis_radius(points)
    spacing = np.sqrt(shape.area / len(surface))
    assert (nearest > depth - 1e-9).all()
    assert (nearest - depth < 5 * spacing).all() and np.median(nearest - depth) < spacing


@pytest.mark.parametrize("name", ALL)
def test_random_samples_lie_on_the_surface_evenly(name):
    """Their share beyond a plane of each axis is that of the mesh."""
    shape = ALL[name]
    points = shape.random_sample(4000, 7)
    assert np.abs(shape.field(points)).max() < 1e-6
    if name in MESHED:
        vertices, triangles = MESHED[name][1]
        flat = distance.points_on_triangles(vertices[triangles], 4000, np.random.default_rng(8))
        share = np.mean(flat > 0.2, axis=0)
        assert np.mean(points > 0.2, axis=0) == pytest.approx(share, abs=0.04)


@pytest.mark.parametrize("name", MESHED)
def test_meshes_are_closed_and_their_vertices_lie_on_the_shape(medial, name):
    shape, (vertices, triangles) = MESHED[name]
    assert len(triangles) == 12 if name == "box" else 2000 <= len(triangles) <= 6000
    assert medial.open_edges(vertices, triangles) == 0
    assert np.array_equal(np.unique(triangles), np.arange(len(vertices)))
    assert np.abs(shape.field(vertices)).max() < 1e-12
    others = {"shell": (2, 4), "spherical shell": (2, 4), "torus": (1, 0)}
    found = topology.components(triangles), topology.euler(triangles)
    assert found == others.get(name, (1, 2))


@pytest.mark.parametrize("name", MESHED)
def test_meshes_face_outward_and_fill_the_shape(name):
    shape, (vertices, triangles) = MESHED[name]
    step = 0.02 * topology.unit_normals(vertices, triangles)
    middle = vertices[triangles].mean(axis=1)
    assert shape.inside(middle - step).all() and not shape.inside(middle + step).any()
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    x = np.random.default_rng(0).uniform(low, high, (100_000, 3))
    volume = np.mean(shape.inside(x)) * np.prod(high - low)
    assert topology.volume(vertices, triangles) == pytest.approx(volume, rel=0.03)


def test_weld_joins_equal_corners_and_drops_what_has_no_area_left():
    soup = meshes.box((2, 2, 2))
    vertices = soup[0][soup[1]].reshape(-1, 3)
    triangles = np.arange(len(vertices)).reshape(-1, 3)
    welded = meshes.weld((vertices, np.concatenate((triangles, [[0, 0, 1]])).astype(np.int32)))
    assert len(welded[0]) == len(soup[0]) and len(welded[1]) == len(soup[1])
