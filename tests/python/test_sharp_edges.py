# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples near sharp edges mirror each other, and the axis of their surface is clean there."""

import itertools

import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation
from support import distance, measure, meshes
from support.shape_meshes import MESHED
from support.shapes import Lathe

SHARP, SURFACE = 1, 4
HALF = np.array([1.0, 0.7, 0.4])
SPACING = 0.05
ROWS = (0.75, 1.6)


def beside(samples, edge, signs, face):
    """(k, 2) distance and arc length along an edge of the box of the samples on one of its two faces."""
    other = 3 - edge - face
    on_face = samples.points[samples.kind == SURFACE]
    on_face = on_face[np.isclose(on_face[:, face], signs[face] * HALF[face], atol=1e-12)]
    return np.column_stack((HALF[other] - signs[other] * on_face[:, other], on_face[:, edge]))


EDGES = [(edge, np.insert([x, y], edge, 0)) for edge in range(3) for x in (1, -1) for y in (1, -1)]


def in_row(places, row):
    return np.sort(places[np.abs(places[:, 0] - ROWS[row] * SPACING) < 1e-9, 1])


def away_from_corners(along, edge):
    """The places far from the ends of an edge: near a corner not all rows fit."""
    return along[np.abs(along) < HALF[edge] - 3.3 * SPACING]


@pytest.mark.parametrize("counts", [(1, 1, 1), (8, 6, 4)])
def test_rows_are_the_same_on_both_sides(medial, counts):
    samples = medial.sample_surface(*meshes.box(counts), spacing=SPACING)
    for edge, signs in EDGES:
        places = [beside(samples, edge, signs, face) for face in range(3) if face != edge]
        for row in (0, 1):
            left, right = (in_row(x, row) for x in places)
            assert len(left) >= 2 * HALF[edge] / SPACING - 5
            assert left == pytest.approx(right, abs=1e-9)
        for x in places:  # between the rows and the edge there is nothing, but for the corners
            inner = np.abs(x[:, 1]) < HALF[edge] - 3.3 * SPACING
            assert x[inner, 0].min() > (ROWS[0] - 1e-9) * SPACING


def test_rows_do_not_depend_on_the_triangles(medial):
    both = [
        medial.sample_surface(*meshes.box(counts), spacing=SPACING)
        for counts in ((1, 1, 1), (8, 6, 4))
    ]
    for edge, signs in EDGES:
        for face, row in itertools.product({0, 1, 2} - {edge}, (0, 1)):
            one, other = (in_row(beside(x, edge, signs, face), row) for x in both)
            one, other = away_from_corners(one, edge), away_from_corners(other, edge)
            assert one == pytest.approx(other, abs=1e-9)


def test_rows_leave_room(medial):
    samples = medial.sample_surface(*meshes.box((1, 1, 1)), spacing=SPACING)
    surface = samples.kind == SURFACE
    alike = np.round(samples.normals[surface]) @ (1, 2, 3)
    points = samples.points[surface] + 10 * alike[:, None]  # faces apart from each other
    nearest = cKDTree(points).query(points, 2)[0][:, 1]
    assert nearest.min() >= 0.7 * SPACING
    crease = cKDTree(samples.points[samples.kind <= SHARP])
    assert crease.query(samples.points[surface])[0].min() >= 0.7 * SPACING


def test_no_rows(medial):
    samples = medial.sample_surface(*meshes.box((1, 1, 1)), spacing=SPACING, mirrored_rows=0)
    assert all(len(in_row(beside(samples, *EDGES[0], face), 0)) == 0 for face in (1, 2))


def inner_axis(medial, name, rotation, **options):
    """Largest distance of its vertices from the true axis in ball radii, p99 of its points' distance in percent of
    the diagonal, and how many vertices lie outside."""
    shape, (vertices, triangles) = MESHED[name]
    turn = rotation.as_matrix()
    turned = (vertices @ turn.T).astype(np.float32).astype(float)
    samples = medial.sample_surface(turned, triangles, count=6000, smooth=name != "box", **options)
    analysis = medial.MedialAnalysis(samples.points, triangles, vertices=turned)
    mesh = analysis.extract(side=medial.Side.INNER)
    cut = measure.fan_triangles(mesh.vertices, mesh.face_offsets, mesh.face_vertices)
    output = distance.points_on_triangles(cut, 10000, np.random.default_rng(0))
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    off_axis = shape.axis_distance(mesh.vertices @ turn) / mesh.radius
    p99 = np.quantile(shape.axis_distance(output @ turn), 0.99) / diagonal * 100
    return off_axis.max(), p99, int((shape.field(mesh.vertices @ turn) > 0).sum())


@pytest.mark.parametrize("rotation", [Rotation.identity(), Rotation.random(random_state=1)])
@pytest.mark.parametrize("name", ["box", "cylinder", "frustum"])
def test_the_axis_runs_straight_into_sharp_edges(medial, name, rotation):
    jagged, jagged_p99, _ = inner_axis(medial, name, rotation, mirrored_rows=0)
    off_axis, p99, outside = inner_axis(medial, name, rotation)
    assert outside == 0
    assert p99 < 0.6 * jagged_p99
    if name != "box":  # where three edges meet there is no room for all rows
        assert off_axis < 0.15 < 0.4 < jagged


def test_patches_round_the_tip_of_a_cone_do_not_leave_it(medial):
    vertices, triangles = meshes.lathe(np.array([(0, -1), (1, -1), (0, 1)], dtype=float), 16)
    samples = medial.sample_surface(vertices, triangles, count=2000, smooth=True)
    cone = Lathe(((0.0, -1.0), (1.0, -1.0), (0.0, 1.0)))
    assert cone.field(samples.points).max() < 0.005
    assert cone.field(samples.points).min() > -0.05
