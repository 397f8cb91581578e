# SPDX-License-Identifier: GPL-3.0-or-later
"""The smooth surface of solids with rounded edges: their flat faces and straight sides stay flat and straight.

Rows of a fillet or of a sphere beside a wall must not lean its normals, and where two fillets meet in a mitre, none of
them may lean along the other. Either would bend the wall by a share of its length.
"""

from __future__ import annotations

import numpy as np
import pytest
from support import rounded
from support.poses import random_turn

RADIUS = 0.04


def sampled(medial, mesh):
    points, triangles = mesh
    return medial.sample_surface(points, triangles, count=4000, smooth=True).points


@pytest.mark.parametrize("name", ["triangle", "hexagon", "angle"])
def test_fillets_are_straight_up_to_the_mitre(medial, name):
    corners = np.array(rounded.OUTLINES[name])
    points = sampled(medial, rounded.rounded_prism(corners, RADIUS, 5))
    assert rounded.off_rounded_prism(points, corners, RADIUS).max() < 0.02 * RADIUS


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(
    ("radius", "rows", "bar"), [(0.1, 4, 0.001), (0.2, 4, 0.001), (0.4, 4, 0.002), (0.6, 8, 0.001)]
)
def test_faces_of_a_rounded_box_are_flat(medial, radius, rows, bar, turned):
    """They bulged by up to 6 % of half the side; and so did the strips of fillets, whose ends lie beside spheres."""
    half = (1.0, 1.0, 1.0)
    points, triangles = rounded.rounded_box(half, radius, rows)
    turn = random_turn(2) if turned else np.eye(3)
    placed = (points @ turn.T).astype(np.float32).astype(float)
    assert (
        rounded.off_rounded_box(sampled(medial, (placed, triangles)) @ turn, half, radius).max()
        < bar
    )


@pytest.mark.parametrize(("edge", "rows"), [(0.05, 4), (0.1, 4), (0.2, 6), (0.3, 4), (1.0, 6)])
def test_sides_of_a_rod_are_straight(medial, edge, rows):
    """They bulged by up to 9 % of the radius; an edge of 1 makes a capsule."""
    points = sampled(medial, rounded.rod(4.0, edge, rows, 64))
    assert rounded.off_rod(points, 4.0, edge).max() < 0.002


@pytest.mark.parametrize("bend", [0.0, 3e-4])
def test_walls_that_are_not_quite_flat_stay_so(medial, bend):
    """As those of scaled or exported models, whose triangles are no flat parts any more."""
    corners = np.array(rounded.OUTLINES["hexagon"])
    points, triangles = rounded.rounded_prism(corners, RADIUS, 5)
    points = points + bend * np.random.default_rng(1).uniform(-1, 1, points.shape)
    assert (
        rounded.off_rounded_prism(sampled(medial, (points, triangles)), corners, RADIUS).max()
        < 0.002
    )
