# SPDX-License-Identifier: GPL-3.0-or-later
"""The decision between inside and outside: by faces, normals or Tight Cocone, and the reason."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..errors import InvalidInputError
from ..machine import native
from ..settings import SidesFrom
from ..shape.shape import Shape
from ..shape.triangles import FEW, some_of
from .analysed import Sides
from .buried_samples import outer_share, sides_of_faces

# Where a smaller share of the faces that do not lie in the solid bounds it, they are a sheet: half of a
# wavy sheet does.
_BOUNDING = 0.75  # derived: kBounding
_CLOSED = "the faces are closed"


def resolve_sides(wanted: SidesFrom, triangles: Ints, gaps: int, normals: Floats | None) -> Sides:
    """Decide on a source if AUTOMATIC is wanted; check that any other wanted source is there.

    Parameters
    ----------
    wanted : SidesFrom
    triangles : (m, 3) int32
    gaps : int
        The number of edges at which the triangles are open.
    normals : (n, 3) float64 or None

    Raises
    ------
    InvalidInputError
        The wanted source is not there.
    """
    has_normals = normals is not None and bool(normals.any())
    if wanted is SidesFrom.AUTOMATIC:
        source = _automatic(len(triangles) > 0 and gaps == 0, has_normals)
        if source is SidesFrom.SURFACE:
            return Sides(source, _CLOSED)
        left = SidesFrom.AUTOMATIC if source is SidesFrom.TIGHT_COCONE else source
        if len(triangles):
            return Sides(left, f"the mesh is open at {gaps:,} edges")
        return Sides(left, "the points have no faces" + ("" if has_normals else " and no normals"))
    if wanted is SidesFrom.SURFACE and not len(triangles):
        raise InvalidInputError(
            "Expected faces for Inside Decided By Surface, found points only; "
            "choose Inside Decided By Automatic or Tight Cocone"
        )
    if wanted is SidesFrom.NORMALS and not has_normals:
        raise InvalidInputError(
            "Expected an attribute 'normal' of the points, vectors that are not all zero, for "
            "Inside Decided By Normals, found none; choose Inside Decided By Automatic or Tight Cocone"
        )
    return Sides(wanted, "as chosen", is_chosen=True)


def resolve_sides_of_samples(wanted: SidesFrom, shape: Shape, spacing: float) -> Sides:
    """Do the same as `resolve_sides` for samples of faces, which have the normals of the faces.

    The solid of an open mesh is the region where its winding number is above one half, provided that most of the faces
    outside of this region's interior bound it. The faces of a sheet do not; there the votes of the normals determine
    what lies behind it, which `decide` takes only for an axis of both sides.

    The spacing is the distance of neighbouring samples.
    """
    if wanted is not SidesFrom.AUTOMATIC:
        return Sides(wanted, "as chosen", is_chosen=True)
    gaps = shape.open_edges
    bounded = gaps == 0 or outer_share(shape, spacing) >= _BOUNDING
    # Normals mean nothing where more of the edges lie between faces of opposite orientation.
    turned = bounded or shape.turned_share <= FEW
    is_open = f"the mesh is open at {gaps:,} edges"
    by_winding = f"the winding number of the faces, for {is_open}"
    reasons = {
        SidesFrom.SURFACE: by_winding if gaps else _CLOSED,
        SidesFrom.NORMALS: f"those of the faces, for {is_open}",
        SidesFrom.TIGHT_COCONE: f"{is_open}, and its faces cannot be turned to the same side",
    }
    source = _automatic(bounded, turned)
    return Sides(source, reasons[source])


def are_sheets(shape: Shape, part: Ints, is_open: Flags, spacing: float) -> Flags:
    """Mark the connected parts that are sheets among all others, (count,), given the (m,) part of each face, or -1.

    An open part that lies in the solid bounds nothing, and a closed one there does no harm. The spacing is the distance
    of neighbouring samples.
    """
    count = len(is_open)
    rows = np.flatnonzero(part >= 0)
    rows = rows[some_of(len(rows))]
    areas, buried, inside = sides_of_faces(shape, rows, spacing)
    everywhere = np.ones(len(rows), np.bool_)
    outer, bounding, every = (
        np.bincount(part[rows], areas * counts, count) for counts in (~inside, ~buried, everywhere)
    )
    return (every > 0.0) & np.where(outer > 0.0, bounding < _BOUNDING * outer, is_open)


def _automatic(bounded: bool, has_normals: bool) -> SidesFrom:
    """Return the source that the compiled module takes for AUTOMATIC: the rule is there."""
    with native.own_errors() as module:
        return SidesFrom[module.automatic_sides(bounded, has_normals).name]


def decided(sides: Sides, analysis: Any) -> Sides:
    """Replace AUTOMATIC by the source that the analysis chose: Tight Cocone, or poles where many contradict it."""
    if sides.source is not SidesFrom.AUTOMATIC:
        return sides
    source, reason = SidesFrom[analysis.sides_from.name], sides.reason
    if source is SidesFrom.POLES:
        against = f"{analysis.pole_disagreement:.0%}"
        reason = f"{reason}, and the poles of {against} of the points contradict Tight Cocone"
    return Sides(source, reason)
