# SPDX-License-Identifier: GPL-3.0-or-later
"""The angle of a direction without the C library and NumPy, whose last bits differ from machine to machine."""

from __future__ import annotations

import math

import numpy as np

from .arrays import Floats

_HALVINGS = 3  # then the tangent of an angle is below 0.1
_TERMS = 9  # of Gregory's series there, whose next one is below 1e-20


def angle_of(x: Floats, y: Floats) -> Floats:
    """Return the angles of (x, y) from the X axis, in radians from -pi to pi; 0 where both are 0.

    Parameters
    ----------
    x, y : (n,) float64
        Shares of a length: squares of them do not overflow.
    """
    high, low = np.maximum(np.abs(x), np.abs(y)), np.minimum(np.abs(x), np.abs(y))
    tangent = low / np.where(high > 0.0, high, 1.0)
    for _ in range(_HALVINGS):
        tangent = tangent / (1.0 + np.sqrt(1.0 + tangent * tangent))
    square = tangent * tangent
    series = np.zeros_like(tangent)
    for k in range(_TERMS, -1, -1):
        series = 1.0 / (2 * k + 1) - square * series
    angle = 2.0**_HALVINGS * tangent * series
    angle = np.where(np.abs(y) > np.abs(x), math.pi / 2 - angle, angle)
    angle = np.where(x < 0.0, math.pi - angle, angle)
    return np.where(y < 0.0, -angle, angle)
