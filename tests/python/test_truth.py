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
from support.shapes import MORE_SHAPES, SHAPES, Prolate, Shell, cylinder, frustum

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


@pytest.mark.parametrize("name", [*SHAPES, *MORE_SHAPES])
def test_axis_points_lie_on_the_axis(name):
    shape = ALL[name]
    points = np.concatenate((shape.axis_points(500, 3), shape.rim_points(40)))
    assert shape.axis_distance(points).max() < 1e-7 and shape.inside(points).all()


@pytest.mark.turn
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


@pytest.mark.parametrize("name", [*SHAPES, *MORE_SHAPES])
def test_random_samples_lie_on_the_surface_evenly(name):
    """Their share beyond a plane of each axis is that of the mesh."""
    shape = ALL[name]
    points = shape.random_sample(4000, 7)
    assert np.abs(shape.field(points)).max() < 1e-6
    if name in MESHED:
        vertices, triangles = MESHED[name][1]
        flat = distance.points_on_triangles(vertices[triangles], 4000, np.random.default_rng(8))
        for axis in range(3):
            assert np.mean(points[:, axis] > 0.2) == pytest.approx(
                np.mean(flat[:, axis] > 0.2), abs=0.04
            )


# --- closed forms


def test_a_tall_cylinder_has_a_segment_and_two_cones():
    """|z| <= H - R, and 45 degrees from each rim to its apex: radius R there, R - rho on the cones."""
    radius, half = 0.5, 1.0
    segments = {
        tuple(map(tuple, np.sort(np.abs(s), axis=0))) for s in _segments(radius, radius, half)
    }
    assert segments == {((0, 0.5), (0.5, 1.0)), ((0, 0.5), (0, 0.5))}
    shape = cylinder(radius, half)
    on_cone = np.array([[0.3, 0.0, 0.8], [0.0, -0.1, -0.6]])
    assert shape.axis_distance(on_cone).max() < 1e-12
    assert np.allclose(shape.axis_radius(on_cone), [0.2, 0.4])
    assert np.allclose(shape.axis_radius(np.array([[0.0, 0.0, 0.4]])), radius)


def test_a_flat_cylinder_has_a_disc_and_two_cones():
    """rho <= R - H at z = 0, and from there to the rims: radius H on the disc."""
    segments = {tuple(map(tuple, s)) for s in _segments(1.0, 1.0, 0.4)}
    assert segments == {
        ((0, 0), (0.6, 0)),
        ((0.6, 0), (1, 0.4)),
        ((0.6, 0), (1, -0.4)),
    }
    assert np.allclose(cylinder(1.0, 0.4).axis_radius(np.array([[0.1, 0.3, 0.0]])), 0.4)


def _segments(bottom, top, half):
    return np.round(frustum(bottom, top, half).axis_segments, 12) + 0.0


@pytest.mark.parametrize("bottom, top, half", [(1.0, 0.5, 0.8), (0.9, 0.3, 1.5), (0.8, 0.0, 0.8)])
def test_a_tall_frustum_has_a_segment_between_its_two_inscribed_balls(bottom, top, half):
    """The balls that touch an end and the wall all round have radius bottom tan(base angle / 2), and likewise."""
    base = np.arctan2(2 * half, bottom - top)
    low, high = bottom * np.tan(base / 2), top * np.tan((np.pi - base) / 2)
    assert low + high < 2 * half
    ends = np.array([[0, 0, low - half], [0, 0, half - high]])
    shape = frustum(bottom, top, half)
    assert shape.axis_distance(ends).max() < 1e-12
    assert np.allclose(shape.axis_radius(ends), [low, high], atol=1e-12)
    on_z = [s for s in shape.axis_segments if np.allclose(s[:, 0], 0)]
    assert len(on_z) == 1 and np.allclose(np.sort(on_z[0][:, 1]), ends[:, 2])


@pytest.mark.parametrize("bottom, top, half", [(1.0, 0.7, 0.3), (2.0, 1.9, 0.2)])
def test_a_flat_frustum_has_a_disc_halfway(bottom, top, half):
    """Its radius is bottom - half / tan(base angle / 2): there the ball between the ends touches the wall."""
    base = np.arctan2(2 * half, bottom - top)
    rim = bottom - half / np.tan(base / 2)
    shape = frustum(bottom, top, half)
    assert shape.axis_distance(np.array([[rim, 0, 0], [0, 0.5 * rim, 0]])).max() < 1e-12
    assert shape.axis_distance(np.array([[rim + 0.01, 0, 0]])).min() > 1e-3
    assert np.allclose(shape.axis_radius(np.array([[0, rim, 0], [0, 0, 0]])), half)


def test_a_prolate_spheroid_has_a_segment():
    """|x| <= (a^2 - c^2) / a with radius c sqrt(1 - x^2 / (a^2 - c^2)): c^2 / a at its ends."""
    shape = Prolate(1.0, 0.5, 0.5)
    ends = shape.rim_points(2)
    assert np.allclose(ends[:, 0], [-0.75, 0.75])
    assert np.allclose(shape.axis_radius(ends), 0.25)
    assert np.allclose(-shape.field(ends), 0.25, atol=1e-6)


def test_a_spherical_shell_has_the_sphere_halfway():
    shape = Shell(0.8, 0.8, 0.8, 0.4)
    points = shape.random_sample(1000)
    assert set(np.round(np.linalg.norm(points, axis=1), 9)) == {0.6, 1.0}
    assert np.allclose(np.linalg.norm(shape.axis_points(100), axis=1), 0.8)
    assert shape.area == pytest.approx(4 * np.pi * (0.36 + 1.0))


# --- the meshes


@pytest.mark.parametrize("name", MESHED)
def test_meshes_are_closed_and_their_vertices_lie_on_the_shape(medial, name):
    shape, (vertices, triangles) = MESHED[name]
    assert len(triangles) == 12 if name == "box" else 2000 <= len(triangles) <= 6000
    assert medial.open_edges(vertices, triangles) == 0
    assert np.array_equal(np.unique(triangles), np.arange(len(vertices)))
    assert np.abs(shape.field(vertices)).max() < 1e-12
    components, euler = topology.components(triangles), topology.euler(triangles)
    assert (components, euler) == {"shell": (2, 4), "spherical shell": (2, 4), "torus": (1, 0)}.get(
        name, (1, 2)
    )


@pytest.mark.parametrize("name", MESHED)
def test_meshes_face_outward_and_fill_the_shape(name):
    shape, (vertices, triangles) = MESHED[name]
    corners = vertices[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    step = 0.02 * normal
    middle = corners.mean(axis=1)
    assert shape.inside(middle - step).all() and not shape.inside(middle + step).any()
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    x = np.random.default_rng(0).uniform(low, high, (100_000, 3))
    assert topology.volume(vertices, triangles) == pytest.approx(
        np.mean(shape.inside(x)) * np.prod(high - low), rel=0.03
    )


def test_sharp_shapes_have_meshes():
    assert set(SHARP) < set(MESHED)


def test_weld_joins_equal_corners_and_drops_what_has_no_area_left():
    soup = meshes.box((2, 2, 2))
    vertices, triangles = (
        soup[0][soup[1]].reshape(-1, 3),
        np.arange(3 * len(soup[1])).reshape(-1, 3),
    )
    welded = meshes.weld((vertices, np.concatenate((triangles, [[0, 0, 1]])).astype(np.int32)))
    assert len(welded[0]) == len(soup[0]) and len(welded[1]) == len(soup[1])
