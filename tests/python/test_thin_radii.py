# SPDX-License-Identifier: GPL-3.0-or-later
"""In bars, also those thinner than samples are apart, curves stand in the middle, with the distance to the faces."""

import medial_axis
import numpy as np
import pytest
from support import inputs, meshes, thick_meshes
from support.thin_solids import turned, union

both_forms = pytest.mark.parametrize("form", ["CLEAN", "CURVE"])


@both_forms
def test_balls_in_a_thin_band_are_no_thicker_than_it(medial, form):
    bar = ((1.0, 0.45, 0.45), (2.0, 0.49, 0.46))
    points, triangles = turned(union(((0.0, 0, 0), (1.0, 1, 1)), bar, ((2.0, 0, 0), (3.0, 1, 1))))
    axis = medial_axis.compute(points, triangles, form=form).axis
    depth = medial.TriangleTree(points, triangles).distances(axis.vertices)
    assert axis.level.betti == (1, 0, 0)
    assert np.abs(axis.radius - depth)[depth < 0.01].max() < 1e-4 and (depth < 0.0051).any()


def _wire_in_bar(medial, sides, wide, form, away=0.0):
    """Return distances of a wire from the middle of a bar between two discs, and its radii, in widths."""
    profile = [(0, 0), (0.6, 0), (0.6, 1), (wide, 1), (wide, 2), (0.6, 2), (0.6, 3), (0, 3)]
    points, triangles = thick_meshes.lathe(profile, sides)
    turn, shift = inputs.rotation(sides), away * np.array((2.0, -2.0, 1.5))
    points = points @ turn.T + shift
    axis = medial_axis.compute(points, triangles, form=form).axis
    outside = medial.winding_number(axis.vertices - shift, points - shift, triangles) < 0.5
    assert not (outside & (axis.level.place < 3)).any()
    row = np.setdiff1d(axis.edges, axis.face_vertices)
    x, y, z = turn.T @ (axis.vertices[row] - shift).T
    bar = np.abs(z - 1.5) < 0.5 - 2 * wide
    assert bar.sum() > 15
    return np.hypot(x, y)[bar] / wide, axis.radius[row[bar]] / wide


@pytest.mark.parametrize("away", [0.0, 1e5])
@pytest.mark.parametrize(("sides", "wide"), [(4, 0.01), (4, 0.04), (8, 0.005), (3, 0.01), (6, 0.1)])
@both_forms
def test_a_curve_stands_in_the_middle_of_a_bar(medial, sides, wide, form, away):
    """Between thick ends it had down to 0.65 of the radius, half of it off the middle."""
    off, radius = _wire_in_bar(medial, sides, wide, form, away)
    assert radius == pytest.approx(np.cos(np.pi / sides), rel=1e-5)
    assert off == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize(("sides", "wide"), [(12, 0.02), (16, 0.01), (24, 0.02), (48, 0.02)])
@both_forms
def test_a_curve_stands_in_the_middle_of_a_round_bar(medial, sides, wide, form):
    """It was up to 0.2 of the radius off, or left the solid for the rim of a disc, where planes meet."""
    off, radius = _wire_in_bar(medial, sides, wide, form)
    assert np.ptp(radius) < 1e-3 and np.cos(np.pi / sides) < radius.min() and radius.max() < 1.0
    assert off.max() < 1e-3


def test_balls_at_the_ends_of_a_curve_leave_the_faces_no_farther_than_round_walls_do(medial):
    """They left them twice as far: by what walls bulge, beyond a wall that bulges."""
    profile = [(0, 0), (0.62, 0), (0.62, 0.3), (0.94, 0.6), (0.82, 1.4), (0.82, 2.3), (0, 2.3)]
    points, triangles = thick_meshes.lathe(profile, 32)
    axis = medial_axis.compute(points, triangles, form="CURVE").axis
    depth = medial.TriangleTree(points, triangles).distances(axis.vertices)
    assert (axis.radius - depth).max() < 0.94 * (1 - np.cos(np.pi / 32))


@pytest.mark.parametrize("around, tube, across", [(48, 0.2, 20), (96, 0.02, 16)])
def test_a_curve_in_a_torus_has_the_radius_of_its_tube(around, tube, across):
    axis = medial_axis.compute(*meshes.torus(1.0, tube, around, across), form="CURVE").axis
    assert axis.radius == pytest.approx(tube, rel=2e-3)
