# SPDX-License-Identifier: GPL-3.0-or-later
"""A shape in its own frame, the centre of its box, where lengths are computed as exactly as at the origin."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Floats
from ..machine import native
from ..small_matrices import placed
from .shape import Shape

_NOTICED = 0.05  # this share of a length is noticed; chosen: unseen


def in_own_frame(shape: Shape) -> tuple[Shape, Floats]:
    """Return a shape whose frame leads back from the centre of its box, and where this centre was.

    The shape stays where it is if its coordinates were rounded to float32: what that costs depends on their distance
    from the origin (`Shape.rounding`), and the arithmetic in 64 bits loses nothing compared with it.
    """
    origin = own_origin(shape.points)
    if not origin.any():
        return shape, origin
    frame = shape.frame.copy()
    frame[:3, 3] = placed(origin, shape.frame)
    far = max(shape.far, float(np.abs(shape.points).max()))
    return replace(shape, points=shape.points - origin, frame=frame, far=far), origin


def own_origin(points: Floats) -> Floats:
    """Return the centre of the box along each axis where it may be subtracted exactly, (3,), 0 along others.

    That is where all coordinates are within a factor of two (Sterbenz); elsewhere the box is no farther away than its
    size. It is 0 for coordinates that were rounded to float32, and for those that are not finite.
    """
    with native.own_errors() as module:
        if not len(points) or not np.isfinite(points).all() or module.are_single(points):
            return np.zeros(3)
    low, high = points.min(axis=0), points.max(axis=0)
    exact = (high <= 2.0 * low) | (low >= 2.0 * high)
    return np.where(exact, 0.5 * low + 0.5 * high, 0.0)


def rounding_warning(shape: Shape, length: float, what: str) -> str:
    """Return a sentence where coordinates are not known to a small share of a length; "" where they are.

    A length of 0 is unknown.
    """
    if length <= 0.0 or shape.rounding <= _NOTICED * length:
        return ""
    return (
        f"coordinates so far from the origin are known to about {shape.rounding:.2g} only, where {what} {length:.2g}; "
        "move the solid nearer to the origin before they are rounded"
    )
