# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a solid is thinner than its samples are apart, radii are no larger than the distance to the faces."""

import medial_axis
import pytest
from support import meshes
from support.thin_solids import turned, union


def dumb_bell(thick, wide):
    """Two cubes of side 1, joined by a bar as thick and as wide as this."""
    low = 0.45
    bar = ((1.0, low, low), (2.0, low + wide, low + thick))
    return union(((0.0, 0, 0), (1.0, 1, 1)), bar, ((2.0, 0, 0), (3.0, 1, 1)))


@pytest.mark.turn
@pytest.mark.parametrize("pose", [0, 1])
@pytest.mark.parametrize(
    ("thick", "wide"), [(0.01, 0.01), (0.02, 0.02), (0.005, 0.005), (0.01, 0.04)]
)
@pytest.mark.parametrize("form", ["CLEAN", "CURVE"])
def test_balls_in_a_thin_bar_are_no_thicker_than_it(medial, thick, wide, pose, form):
    """They were up to five times as large, as they ended at samples."""
    mesh = dumb_bell(thick, wide)
    points, triangles = turned(mesh, pose) if pose else mesh
    axis = medial_axis.compute(points, triangles, form=form).axis
    depth = medial.surface_distances(axis.vertices, points, triangles)
    assert axis.level.betti == (1, 0, 0)
    assert (axis.radius - depth).max() < 2e-3
    thin = depth < thick
    assert (axis.radius - depth)[thin].max() < 0.1 * thick and (depth[thin] > 0.4 * thick).any()


@pytest.mark.parametrize("around, tube, across", [(48, 0.2, 20), (96, 0.02, 16)])
def test_a_curve_in_a_torus_has_the_radius_of_its_tube(around, tube, across):
    """Its flat faces are closer to the middle than the smooth surface for which they stand."""
    axis = medial_axis.compute(*meshes.torus(1.0, tube, around, across), form="CURVE").axis
    assert axis.radius == pytest.approx(tube, rel=2e-3)
