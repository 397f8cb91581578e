# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings about a solid as its samples show it, which all results share; a sentence each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..arrays import Floats, Ints
from ..errors import Severe
from ..machine import native
from ..samples.chosen import ChosenSamples
from ..samples.sampling_warnings import differs_warning, sampling_warnings
from ..settings import SamplingMode, Side, SidesFrom
from ..shape.shape import Shape

# A larger share of samples that are not flat causes a warning; clean scans stay below 0.06, sharp edges included.
_UNEVEN = 0.1  # measured: 0.06 on clean scans
# A triangle, or an edge, that is this many times as wide as the median one spans an opening.
_WIDE = 10.0  # chosen: unseen
_CHUNK = 1 << 16  # the number of triangles measured at once; bounds the memory
_OF_POINTS_ALONE = (SidesFrom.TIGHT_COCONE, SidesFrom.POLES)


def solid_warnings(
    shape: Shape,
    side: Side,
    sides: SidesFrom,
    chosen: ChosenSamples,
    betti: tuple[int, int, int] | None = None,
) -> Iterator[str]:
    """Warn about the samples, about what was taken for inside, and where the faces have another topology.

    The sides are the source that decided between inside and outside. The Betti numbers are pieces, loops and cavities
    of the solid that the samples show; None where nothing of that kind was computed.
    """
    yield from sampling_warnings(shape, chosen)
    walls = chosen.samples.walls
    told = chosen.differs or (walls is not None and walls.are_missed)
    if betti is not None and sides is SidesFrom.SURFACE and not told:
        yield from _of_topology(shape, chosen, betti)
    if sides is SidesFrom.SURFACE and chosen.gaps and side is not Side.BOTH:
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
    if chosen.normals_look_inward:
        yield Severe(
            "the normals point inward, so inside and outside are exchanged; turn them round, "
            "or choose Inside Decided By Tight Cocone, and compute again"
        )


def _of_topology(shape: Shape, chosen: ChosenSamples, betti: tuple[int, int, int]) -> Iterator[str]:
    """Compare the topology of the samples with what the faces say about that of the solid.

    Faces of one solid say all of it. Others, which are open or meet at edges of more than two, still say that there are
    no more pieces than connected parts, and no fewer cavities than closed parts that look inward.
    """
    by_faces = chosen.samples.by_faces
    if by_faces is not None:
        if betti != by_faces and not _of_parts_that_overlap(chosen):
            yield differs_warning(shape, chosen)
        return
    parts, inward = shape.shells
    if betti[0] > parts:
        yield (
            f"the axis has {betti[0]:,} pieces, and the faces have {parts:,} connected parts, so it is torn where the "
            "solid is thinner than its samples are apart, or where openings were closed; more samples may help"
        )
    if betti[2] < inward:
        yield (
            f"the axis has {betti[2]:,} cavities, and {inward:,} parts of the faces look inward as those of cavities "
            "do: some are smaller than the samples are apart; more samples may help"
        )


def _of_parts_that_overlap(chosen: ChosenSamples) -> bool:
    """Return whether parts lie in each other, of which the faces count each by itself."""
    samples = chosen.samples
    return samples.overlaps or bool(samples.buried and samples.by_faces and samples.by_faces[0] > 1)


def _of_points_alone(chosen: ChosenSamples) -> Iterator[str]:
    """Warn about the surface by which points alone determine the inside."""
    samples = chosen.samples
    if chosen.sides.source is SidesFrom.POLES:
        yield from pole_warnings(samples.analysis, samples.points)
    else:
        yield from cocone_warnings(samples.analysis.tight_cocone, samples.points)


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
    if wide := _far_above(np.linalg.norm(along, axis=1)):
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
