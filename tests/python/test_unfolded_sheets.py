# SPDX-License-Identifier: GPL-3.0-or-later
"""Folds beside rims: vertices inside of a sheet that lie beyond its rim come back, along the sheet."""

import numpy as np
import pytest
from medial_axis.core.mid_surface.unfolded_sheets import unfolded

# A square round a vertex, as a fan.
RING = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], float)
FAN = np.array([(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)], np.int32)


def found(inner, free=(1.0, 1.0, 0.0)):
    """Where the inner vertex comes to, which may go in the free directions."""
    stays = np.arange(5) < 4
    normals = np.tile((0.0, 0.0, 1.0), (4, 3, 1))
    places = np.concatenate((RING, [inner]))
    return unfolded(places, FAN, normals, stays, lambda _, ways: ways * np.array(free))


@pytest.mark.parametrize(
    "inner, free, place",
    [
        ((3.0, 1.0, 0.25), (1.0, 1.0, 0.0), (1.0, 1.0, 0.25)),  # along the sheet
        ((3.0, 0.5, 0.0), (1.0, 0.0, 0.0), (1.0, 0.5, 0.0)),  # along the line where sheets meet
    ],
)
def test_a_vertex_beyond_the_rim_comes_back(inner, free, place):
    places = found(inner, free)
    assert np.array_equal(places[:4], RING)
    np.testing.assert_allclose(places[4], place, atol=1e-15)


def test_what_is_not_folded_stays():
    inner = (1.9, 0.3, 0.0)
    assert np.array_equal(found(inner)[4], inner)
