# SPDX-License-Identifier: GPL-3.0-or-later
"""The angle from which edges of a shape are sharp."""

from __future__ import annotations

import math

from ..settings import Settings
from .shape import Shape

# Edges are sharp from this multiple of the angle on: tubes of twelve sides are round, and bent ones have 30.1 degrees.
_CLEARLY = 1.01  # measured: 30.1 of 30 degrees


def sharp_angle_of(shape: Shape, settings: Settings) -> float:
    """Return the angle in radians from which edges of the shape are sharp."""
    wider = 2.0 if shape.shaded_smooth else _CLEARLY
    return min(wider * settings.sharp_angle, math.pi)
