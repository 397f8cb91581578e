# SPDX-License-Identifier: GPL-3.0-or-later
"""The decision between inside and outside: by faces, normals or Tight Cocone, the reason, and warnings about it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..errors import InvalidInputError, Severe
from ..machine import native
from ..settings import SidesFrom
from ..shape.shape import Shape
from ..shape.triangles import FEW, some_of
from ..small_matrices import dot
from .analysed import Sides
from .buried_samples import outer_share, sides_of_faces

# A larger share of samples that are not flat causes a warning; clean scans stay below 0.06, sharp edges included.
_UNEVEN = 0.1  # measured: 0.06 on clean scans
# A triangle, or an edge, that is this many times as wide as the median one spans an opening.
_WIDE = 10.0  # chosen: unseen
_CHUNK = 1 << 16  # the number of triangles measured at once; bounds the memory
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


def look_inward(points: Floats, normals: Floats) -> bool:
    """Return whether the normals of the outermost samples along the coordinate axes point inward on the whole."""
    lowest, highest = points.argmin(axis=0), points.argmax(axis=0)
    lengths = np.maximum(np.linalg.norm(normals, axis=1), np.finfo(np.float64).tiny)
    low, high = (normals[rows, range(3)] / lengths[rows] for rows in (lowest, highest))
    return bool(high.sum() < low.sum())


def cocone_warnings(found: Any, points: Floats) -> Iterator[str]:
    """Warn about suspicious properties of a surface that Tight Cocone found, a `_medial.TightCocone` of points."""
    if not found.encloses:
        yield Severe(
            "the points enclose nothing, so inner and outer facets mean little; more points may help"
        )
        return
    samples, off = len(found.samples), int(np.count_nonzero(~found.on_surface))
    if off:
        yield (
            f"{off:,} of {samples:,} points are not on the surface that Tight Cocone found: "
            "noise, points inside the shape, or too few of them there"
        )
    edges, vertices = found.nonmanifold_edges, found.nonmanifold_vertices
    if edges or vertices:
        yield (
            f"the surface that Tight Cocone found touches itself at {edges:,} edges and "
            f"{vertices:,} points: noise, or too few points for thin parts"
        )
    if wide := _wide_triangles(points, found.triangles):
        yield (
            f"Tight Cocone closed openings, by {wide:,} triangles more than {_WIDE:g} times as wide "
            "as most: inside is a guess near them"
        )
    if found.cavities:
        yield (
            f"{found.cavities:,} patches of points lie inside like walls of closed cavities, "
            "which Tight Cocone fills; faces, normals or Inside Decided By Poles would keep them"
        )
    uneven = np.count_nonzero(~found.flat) / samples
    if uneven > _UNEVEN:
        yield (
            f"{uneven:.0%} of the points do not look like samples of a smooth surface: too few, "
            "too noisy, or many sharp edges; inside may be wrong there"
        )


def pole_warnings(analysis: Any, points: Floats) -> Iterator[str]:
    """Warn about suspicious properties of the solid that the poles determine.

    It has no triangles. But near its surface neighbours share a facet that crosses it, and points off it share none.

    The sides of the analysis of these (n, 3) points are from the poles.
    """
    crossing = int(native.load().Side.CROSSING)
    pairs = analysis.edges[analysis.side == crossing]
    samples, off = len(analysis.samples), len(analysis.samples) - len(np.unique(pairs))
    if 2 * off > samples:
        yield Severe(
            f"{off:,} of {samples:,} points are not on the surface that the poles tell, so inner and outer facets mean "
            "little: a sheet that bounds no solid, or too few points; side Both needs no inside"
        )
        return
    if off:
        yield (
            f"{off:,} of {samples:,} points are not on the surface that the poles tell: "
            "noise, points inside the shape, or too few of them there"
        )
    along = points[pairs[:, 0]] - points[pairs[:, 1]]
    if wide := _far_above(np.sqrt(dot(along, along))):
        yield (
            f"the surface that the poles tell has {wide:,} edges more than {_WIDE:g} times as long as most, across "
            "openings or where noise tears it: inside is a guess near them"
        )


def _wide_triangles(points: Floats, triangles: Ints) -> int:
    edges = np.empty(len(triangles))
    for start in range(0, len(triangles), _CHUNK):
        corners = points[triangles[start : start + _CHUNK]]
        sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
        edges[start : start + _CHUNK] = sides.max(axis=1)
    return _far_above(edges)


def _far_above(lengths: Floats) -> int:
    """Count the lengths that are many times the median one."""
    return int(np.count_nonzero(lengths > _WIDE * np.median(lengths))) if len(lengths) else 0
