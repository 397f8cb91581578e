# SPDX-License-Identifier: GPL-3.0-or-later
"""Folds beside rims: vertices inside of a sheet that lie beyond its rim come back, along the sheet."""

import numpy as np
from medial_axis.core.mid_surface.unfolded_sheets import unfolded

# A square round a vertex, as a fan.
RING = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], float)
FAN = np.array([(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)], np.int32)


def found(inner, normal=(0.0, 0.0, 1.0), inner_stays=False):
    stays = np.array((True, True, True, True, inner_stays))
    normals = np.tile(np.array(normal), (4, 3, 1))
    return unfolded(np.concatenate((RING, [inner])), FAN, normals, stays)


def test_a_vertex_beyond_the_rim_comes_back_along_the_sheet():
    places = found((3.0, 1.0, 0.25))
    assert np.array_equal(places[:4], RING)
    np.testing.assert_allclose(places[4], (1.0, 1.0, 0.25), atol=1e-15)


def test_what_is_not_folded_stays():
    inner = (1.9, 0.3, 0.0)
    assert np.array_equal(found(inner)[4], inner)


def test_vertices_where_sheets_meet_stay():
    assert np.array_equal(found((3.0, 1.0, 0.0), inner_stays=True)[4], (3.0, 1.0, 0.0))
