# SPDX-License-Identifier: GPL-3.0-or-later
"""Angles and cosines without the C library and NumPy, whose last bits differ from machine to machine."""

from __future__ import annotations

import math
from typing import TypeVar

import numpy as np

from .arrays import Floats

_HALVINGS = 3  # then the tangent of an angle is below 0.1
_GREGORY = 9  # of Gregory's series there, whose next one is below 1e-20
Angles = TypeVar("Angles", float, Floats)
_TAYLOR = 14  # of Taylor's series at half a turn, whose next one is below 3e-16


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
    for k in range(_GREGORY, -1, -1):
        series = 1.0 / (2 * k + 1) - square * series
    angle = 2.0**_HALVINGS * tangent * series
    angle = np.where(np.abs(y) > np.abs(x), math.pi / 2 - angle, angle)
    angle = np.where(x < 0.0, math.pi - angle, angle)
    return np.where(y < 0.0, -angle, angle)


def cosine(angle: Angles) -> Angles:
    """Return the cosine of radians; the error is below 1e-14 up to 20 in absolute value, and grows with the angle."""
    x = angle - 2.0 * math.pi * np.rint(angle / (2.0 * math.pi))
    square = x * x
    result = 1.0 - square / (2 * _TAYLOR * (2 * _TAYLOR - 1))
    for k in range(_TAYLOR - 1, 0, -1):
        result = 1.0 - square * result / (2 * k * (2 * k - 1))
    return result


def turn_about(axis: Floats, angle: float) -> Floats:
    """Return the matrix of a turn by radians about a unit axis, (3,)."""
    along, across = np.outer(axis, axis), np.cross(axis, np.identity(3)).T
    cos, sin = cosine(angle), cosine(angle - math.pi / 2)
    return along + cos * (np.identity(3) - along) + sin * across
