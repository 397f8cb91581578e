# SPDX-License-Identifier: GPL-3.0-or-later
"""Rims of even meshes of points without faces: no saws, and balls that end at the points."""

import math

import numpy as np
import pytest
from support.crisp_measures import rim_length, rim_turns

pytestmark = pytest.mark.oracle

CLEAN = {"spacings": 1.0}
# shape -> mean angle between rim edges in degrees; n = 8000, the worst measured times 1.5
TURN = {"oblate": 13.0, "ellipsoid": 14.0, "box": 43.0}
OBLATE_RIM = 2 * math.pi * 0.75


@pytest.mark.parametrize("name", TURN)
@pytest.mark.parametrize("seed", [0, 1])
def test_rims_are_no_saws(sampled, name, seed):
    """The rim of the oblate ellipsoid has its length, which is known."""
    _, _, hierarchy = sampled(name, 8000, seed)
    level = hierarchy.even(**CLEAN).extract(relaxed=True)
    facets = hierarchy.extract(**CLEAN)
    assert rim_turns(facets).mean() > 45
    assert rim_turns(level).mean() < TURN[name]
    assert name != "oblate" or 0.98 < rim_length(level) / OBLATE_RIM < 1.05


def test_balls_of_moved_vertices_are_empty(sampled):
    shape, _, hierarchy = sampled("box", 2000)
    level = hierarchy.even(**CLEAN).extract(relaxed=True)
    points = shape.sample(2000, 0)
    nearest = np.linalg.norm(level.vertices[:, None] - points, axis=2).min(axis=1)
    assert level.radius == pytest.approx(nearest, rel=1e-9)
