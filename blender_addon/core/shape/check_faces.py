# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that a shape has faces that can be sampled, and that may bound a solid."""

from __future__ import annotations

import numpy as np

from ..errors import DegenerateInputError, InvalidInputError
from ..settings import SamplingMode, Side
from ..small_matrices import dot, stretches
from .shape import Shape


def check_faces(shape: Shape, wanted: SamplingMode) -> None:
    """Raise InvalidInputError when there are no faces where samples of them are needed."""
    if len(shape.triangles):
        return
    if not shape.of_samples:
        raise InvalidInputError(
            "Expected faces, found only lines; give the object a surface (a curve needs a bevel or "
            "an extrusion), or choose Sampling Vertices"
        )
    if wanted is not SamplingMode.AUTOMATIC:
        raise InvalidInputError(
            f"Expected faces for Sampling {wanted.name.capitalize()}, found points only; "
            "choose Sampling Automatic or Vertices"
        )


def check_not_flat(shape: Shape) -> None:
    """Raise DegenerateInputError when all faces lie in a plane, up to the rounding of their corners."""
    corners = shape.points[np.unique(shape.triangles)]
    around = corners - corners.mean(axis=0)
    columns = np.ascontiguousarray(around.T)
    _, axes, _ = stretches(np.array([[dot(p, q) for q in columns] for p in columns]))
    thickness = float(np.ptp(dot(around, axes[2])))
    if thickness <= shape.rounding:
        raise DegenerateInputError(
            "Expected faces that span a volume, found all of them in one plane; give them "
            "thickness (a Solidify modifier, or an extrusion)"
        )


def check_some_left(shape: Shape, wanted: SamplingMode) -> None:
    """Raise DegenerateInputError when each face counts for nothing, so that none can decide what is inside."""
    if not shape.left_out.all():
        return
    if wanted is not SamplingMode.VERTICES:
        check_not_flat(shape)
    raise DegenerateInputError(
        f"Expected faces that bound a solid, found {len(shape.triangles):,} that repeat others, are sheets or have "
        "no three corners; give them thickness (a Solidify modifier), or choose Inside From Tight Cocone"
    )


def check_not_a_sheet(shape: Shape, side: Side) -> None:
    """Raise DegenerateInputError for an open sheet, unless it is bent and both sides are wanted."""
    check_not_flat(shape)
    if side is not Side.BOTH:
        raise open_sheet_error(shape.open_edges)


def open_sheet_error(gaps: int, of_axis: bool = True) -> DegenerateInputError:
    """Return the error for faces that are open at `gaps` edges and bound no solid, also for results without a side."""
    others = ", or choose Side Both, or Inside Decided By Normals for what lies behind it"
    return DegenerateInputError(
        f"Expected faces that bound a solid, found an open sheet ({gaps:,} open edges); give it thickness (a "
        f"Solidify modifier){others if of_axis else ''}"
    )
