# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings about a shape and its medial axis: assumptions and suspicious results, a sentence each."""

from __future__ import annotations

from collections.abc import Iterator

from ..samples.chosen import ChosenSamples
from ..samples.density import percent
from ..settings import Settings, Side, SidesFrom
from ..shape.shape import Shape
from .medial_axis import MedialAxis
from .solid_warnings import solid_warnings

# A larger share of vertices at which no ball fits between the faces causes a warning. Scans with rough faces have up to
# 0.25.
_MANY_REFUSED = 0.4  # measured: 0.25 on scans


def axis_warnings(
    shape: Shape, settings: Settings, chosen: ChosenSamples, axis: MedialAxis
) -> Iterator[str]:
    betti = None
    if axis.level is not None and not axis.level.loops_left_out:
        betti = axis.level.betti
    yield from solid_warnings(shape, settings.side, settings.sides, chosen, betti)
    if axis.is_empty and not chosen.normals_look_inward:
        yield _why_empty(shape, settings, chosen, axis)
    yield from _refused(axis)


def _refused(axis: MedialAxis) -> Iterator[str]:
    """Warn where crisp places were refused so often that the faces cannot be those of the solid."""
    level = axis.level
    if level is not None and level.refused > _MANY_REFUSED * len(level.place):
        yield (
            f"at {percent(level.refused / len(level.place))} of the vertices no ball fits between the faces, so "
            "balls end at the samples there: faces that overlap or bound nothing, or walls that are "
            "closer than the samples"
        )


def _why_empty(shape: Shape, settings: Settings, chosen: ChosenSamples, axis: MedialAxis) -> str:
    closed = settings.sides is SidesFrom.SURFACE and chosen.gaps == 0
    if axis.zero_area:
        return (
            f"all {axis.zero_area:,} facets that pass the conditions are points or lines, as in an "
            "exact ball; choose Form Clean to see them"
        )
    tell = {SidesFrom.TIGHT_COCONE: "Tight Cocone closed", SidesFrom.POLES: "the poles tell"}
    if settings.sides in tell and settings.side is Side.INNER:
        return (
            f"no facet lies inside the surface that {tell[settings.sides]}; the axis of an open scan "
            "may lie beyond the opening: choose side Both, or lower theta or rho"
        )
    spacing = chosen.samples.spacing
    thickness = 2.0 * shape.volume / shape.area if shape.area > 0.0 else 0.0
    if closed and thickness <= shape.rounding:
        return (
            "the faces enclose no volume, as where each of them stands twice; give them thickness "
            "(a Solidify modifier)"
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
