# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that bound nothing, wrapped in a closed surface (docs/stage_inside.md)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import InvalidInputError
from ..machine import native
from ..machine.progress import Progress
from ..settings import Settings, SidesFrom
from ..small_matrices import length_of
from .shape import Shape

_DISTANCE = 0.05  # of the openings that it closes, from the faces; chosen: axis


def wrapped_shape(shape: Shape, settings: Settings, progress: Progress | None = None) -> Shape:
    """Return the surface round the faces of a shape; `Shape.offset` says how far outside of them it lies.

    Raises
    ------
    InvalidInputError
        There are no faces, or none has an area.
    Cancelled
    """
    if not len(shape.triangles):
        raise InvalidInputError(
            "Expected faces for Inside Decided By Wrap, found points only; "
            "choose Inside Decided By Automatic or Tight Cocone"
        )
    opening = settings.wrap_opening / 100
    distance = _DISTANCE * opening
    with native.own_errors() as module:
        points, triangles = module.wrap(
            shape.points, shape.triangles, opening, distance, progress=progress
        )
    used = shape.points[np.unique(shape.triangles)]
    diagonal = length_of(np.ptp(used, axis=0))
    return Shape(
        points,
        triangles,
        frame=shape.frame,
        of_samples=False,
        reading=np.zeros(len(triangles), np.uint8),
        offset=distance * diagonal,
    )


def without_wrap(settings: Settings) -> Settings:
    """Return the settings for a shape that is wrapped already: its faces are closed."""
    return replace(settings, sides=SidesFrom.SURFACE)


def wrap_reason(shape: Shape, settings: Settings) -> str:
    """Return the reason for what is inside of a wrapped shape, for people."""
    opening = shape.offset / _DISTANCE
    return (
        f"a wrap of the faces, {shape.offset:.3g} outside of them, that closes openings of less than {opening:.3g} "
        f"({settings.wrap_opening:g} % of the diagonal); radii are less by its distance"
    )
