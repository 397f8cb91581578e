# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of shapes with exactly known axes, by way of the add-on: sampled at 16,000, default thresholds."""

import numpy as np
import pytest
from support import axis_bars, inputs, resampled
from support.shape_meshes import MESHED

pytestmark = pytest.mark.oracle

QUICK = ("ellipsoid", "box", "cylinder")
CASES = [
    pytest.param(name, turn, marks=() if name in QUICK and turn < 2 else pytest.mark.slow)
    for name in MESHED
    for turn in range(4)
]


@pytest.mark.parametrize("name, turn", CASES)
def test_bars(name, turn):
    """The mesh is as it is (turn 0), or rotated at random and rounded to float32."""
    shape, mesh = MESHED[name]
    frame = inputs.rotation(turn) if turn else np.eye(3)
    mesh = resampled.turned(mesh, frame) if turn else mesh
    result = resampled.of_surface(mesh, 16_000)
    points = result.chosen.samples.points
    found = axis_bars.measured(shape, mesh, frame, result.axis, len(points))
    assert len(points) == pytest.approx(16_000, rel=0.02)
    assert not found.missed(name), found
    assert found.spike < 0.6, found


def test_the_bars_can_fail():
    """The axis of a sphere is no axis of an ellipsoid."""
    shape, mesh = MESHED["ellipsoid"]
    round_one = resampled.of_surface((mesh[0] / shape.semi_axes, mesh[1]), 2000)
    found = axis_bars.measured(shape, mesh, np.eye(3), round_one.axis, 2000)
    assert "truth_mean" in found.missed("ellipsoid")
