# SPDX-License-Identifier: GPL-3.0-or-later
"""The smooth surface of prisms with rounded edges, whose fillets meet in mitres.

Their long faces are straight. A shared normal that leans along one of them would bend it by as much as the radius of
the fillet.
"""

from __future__ import annotations

import numpy as np
import pytest

HEIGHT, RADIUS, ROWS = 0.3, 0.04, 5
OUTLINES = {  # counter-clockwise; the first corner sees all others
    "triangle": [(0.0, 0.0), (1.0, 0.0), (0.5, 0.8)],
    "hexagon": [(np.cos(a), np.sin(a)) for a in np.arange(6) * np.pi / 3],
    "angle": [(0.3, 0.3), (0.3, 1.0), (0.0, 1.0), (0.0, 0.0), (1.0, 0.0), (1.0, 0.3)],
}


def sides(corners):
    """(k, 2) inward normals of the sides, and their (k,) distances from the origin."""
    along = np.roll(corners, -1, axis=0) - corners
    inward = np.stack([-along[:, 1], along[:, 0]], axis=1)
    inward /= np.linalg.norm(along, axis=1)[:, None]
    return inward, np.sum(inward * corners, axis=1)


def outline(corners, inset):
    """(k, 2) corners of the outline with all sides moved inward."""
    inward, away = sides(corners)
    pairs = [[k - 1, k] for k in range(len(corners))]
    return np.array([np.linalg.solve(inward[pair], away[pair] + inset) for pair in pairs])


def rounded_prism(corners):
    """Its rings from the lower face to the upper one; both of these are fans."""
    turn = np.linspace(0.5 * np.pi, 0.0, ROWS + 1)
    low = [
        np.column_stack((outline(corners, RADIUS * (1 - c)), np.full(len(corners), z)))
        for c, z in zip(np.cos(turn), RADIUS * (1 - np.sin(turn)), strict=True)
    ]
    rings = [*low, *(ring * (1, 1, -1) + (0, 0, HEIGHT) for ring in low[::-1])]
    ids = np.arange(len(rings) * len(corners)).reshape(len(rings), -1)
    a, b = ids[:-1], ids[1:]
    a, b, c, d = (x.ravel() for x in (a, np.roll(a, -1, axis=1), np.roll(b, -1, axis=1), b))
    fan = np.column_stack([ids[0, 1:-1] * 0, ids[0, 1:-1], ids[0, 2:]])
    faces = [fan[:, ::-1], np.column_stack((a, b, c)), np.column_stack((a, c, d)), fan + ids[-1, 0]]
    return np.concatenate(rings), np.concatenate(faces).astype(np.int32)


def off_rounded_prism(points, corners):
    """How far points are from the exact surface, whose sections across a side are quarters of a circle."""
    inward, away = sides(corners)
    from_sides = points[:, :2] @ inward.T - away
    inset = from_sides.min(axis=1)
    if corners is OUTLINES["angle"]:  # one of the sides at its hollow corner is enough
        hollow = np.maximum(from_sides[:, 0], from_sides[:, -1])
        inset = np.minimum(from_sides[:, 1:-1].min(axis=1), hollow)
    below = np.minimum(points[:, 2], HEIGHT - points[:, 2])
    rounded = np.hypot(np.maximum(0, RADIUS - inset), np.maximum(0, RADIUS - below)) - RADIUS
    return np.where(np.minimum(inset, below) < RADIUS, np.abs(rounded), np.minimum(inset, below))


@pytest.mark.parametrize("name", OUTLINES)
def test_fillets_are_straight_up_to_the_mitre(medial, name):
    samples = medial.sample_surface(
        *rounded_prism(np.array(OUTLINES[name])), count=4000, smooth=True
    )
    assert off_rounded_prism(samples.points, OUTLINES[name]).max() < 0.02 * RADIUS
