# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings about a shape and its medial axis: assumptions and suspicious results, a sentence each."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..samples.chosen import ChosenSamples
from ..samples.density import percent
from ..samples.sampling_warnings import sampling_warnings
from ..samples.shape import Shape
from ..samples.sides import cocone_warnings, look_inward, pole_warnings
from ..settings import SamplingMode, Settings, Side, SidesFrom
from ..severe import Severe
from .medial_axis import MedialAxis

# A larger share of vertices at which no ball fits between the faces causes a warning. Scans with rough faces have up to
# 0.25.
_MANY_REFUSED = 0.4
_OF_POINTS_ALONE = (SidesFrom.TIGHT_COCONE, SidesFrom.POLES)


def axis_warnings(
    shape: Shape, settings: Settings, chosen: ChosenSamples, axis: MedialAxis
) -> Iterator[str]:
    yield from sampling_warnings(shape, chosen)
    samples, sides = chosen.samples, settings.sides
    if sides is SidesFrom.SURFACE and chosen.gaps and settings.side is not Side.BOTH:
        yield _open_surface(chosen)
    if sides is SidesFrom.NORMALS and chosen.sampling is not SamplingMode.VERTICES and chosen.gaps:
        yield (
            f"the surface is open at {chosen.gaps:,} edges: inside was taken to be behind its "
            "faces; do not trust the axis near the openings"
        )
    if sides in _OF_POINTS_ALONE:
        if chosen.gaps and not chosen.sides.is_chosen:
            yield Severe(
                f"the {len(shape.triangles):,} faces bound nothing, so their points were read as a cloud: "
                "give sheets thickness (a Solidify modifier), or close the mesh"
            )
        yield from _of_points_alone(chosen)
    normals = samples.normals if sides is SidesFrom.NORMALS else None
    if normals is not None and look_inward(samples.points, normals):
        yield Severe(
            "the normals point inward, so inside and outside are exchanged; turn them round, "
            "or choose Inside From Tight Cocone, and compute again"
        )
    elif axis.is_empty:
        yield _why_empty(shape, settings, chosen, axis)
    yield from _refused(axis)


def _of_points_alone(chosen: ChosenSamples) -> Iterator[str]:
    """Warn about the surface by which points alone tell the inside."""
    samples = chosen.samples
    if chosen.sides.source is SidesFrom.POLES:
        yield from pole_warnings(samples.analysis, samples.points)
    else:
        yield from cocone_warnings(samples.analysis.tight_cocone, samples.points)


def _refused(axis: MedialAxis) -> Iterator[str]:
    """Warn where crisp places were refused so often that the faces cannot be those of the solid."""
    level = axis.level
    if level is not None and level.refused > _MANY_REFUSED * len(level.place):
        yield (
            f"at {percent(level.refused / len(level.place))} of the vertices no ball fits between the faces, so "
            "balls end at the samples there: faces that overlap or bound nothing, or walls that are "
            "closer than the samples"
        )


def _open_surface(chosen: ChosenSamples) -> str:
    closing = chosen.samples.closing
    if not closing:
        return (
            f"the surface is open at {chosen.gaps:,} edges: inside was taken to be where the "
            "winding number of the open surface is above one half"
        )
    return (
        f"the surface is open at {chosen.gaps:,} edges: the solid was taken to be where its winding "
        f"number is above one half, and {closing:,} samples close the openings"
    )


def _why_empty(shape: Shape, settings: Settings, chosen: ChosenSamples, axis: MedialAxis) -> str:
    closed = settings.sides is SidesFrom.SURFACE and chosen.gaps == 0
    if axis.zero_area:
        return (
            f"all {axis.zero_area:,} facets that pass the conditions are points or lines, as in an "
            "exact ball; choose Form Clean to see them"
        )
    if settings.sides is SidesFrom.TIGHT_COCONE and settings.side is Side.INNER:
        return (
            "no facet lies inside the surface that Tight Cocone closed; the axis of an open scan "
            "may lie beyond the opening: choose side Both, or lower theta or rho"
        )
    if settings.sides is SidesFrom.POLES and settings.side is Side.INNER:
        return (
            "no facet lies inside the surface that the poles tell; the axis of an open scan "
            "may lie beyond the opening: choose side Both, or lower theta or rho"
        )
    spacing = chosen.samples.spacing
    thickness = 2.0 * shape.volume / shape.area if shape.area > 0.0 else 0.0
    if closed and thickness <= np.finfo(np.float32).eps * np.abs(shape.points).max():
        return (
            "the faces enclose no volume, as where each of them stands twice; give them thickness (a Solidify modifier)"
        )
    if closed and spacing > thickness:
        return (
            f"the shape is about {thickness:.2g} thick, less than its samples are apart ({spacing:.2g}); "
            "use more samples, or a smaller Spacing"
        )
    if chosen.gaps and settings.side is not Side.OUTER:
        return (
            f"the faces are open at {chosen.gaps:,} edges and bound nothing as thick as the samples are apart "
            f"({spacing:.2g}); give them thickness (a Solidify modifier), or use more samples"
        )
    return "no facet passes the conditions; lower theta or rho, or choose another side"
