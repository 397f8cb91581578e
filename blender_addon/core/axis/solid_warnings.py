# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings about a solid as its samples show it, which all results share; a sentence each."""

from __future__ import annotations

from collections.abc import Iterator

from ..errors import Severe
from ..samples.chosen import ChosenSamples
from ..samples.sampling_warnings import differs_warning, sampling_warnings
from ..samples.sides import cocone_warnings, look_inward, pole_warnings
from ..settings import SamplingMode, Side, SidesFrom
from ..shape.shape import Shape

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
    if normals_look_inward(sides, chosen):
        yield Severe(
            "the normals point inward, so inside and outside are exchanged; turn them round, "
            "or choose Inside Decided By Tight Cocone, and compute again"
        )


def normals_look_inward(sides: SidesFrom, chosen: ChosenSamples) -> bool:
    """Return whether normals decide what is inside, and point into it."""
    samples = chosen.samples
    if sides is not SidesFrom.NORMALS or samples.normals is None:
        return False
    return look_inward(samples.points, samples.normals)


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
