# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings about the samples that were chosen."""

from __future__ import annotations

from collections.abc import Iterator

from ..counted import counted
from ..errors import Severe
from ..settings import SamplingMode
from ..shape.outward_faces import reading_warnings
from ..shape.own_frame import rounding_warning
from ..shape.shape import Shape
from ..small_matrices import placed
from .chosen import ChosenSamples
from .density import percent
from .doubts import words_of_place
from .scan import is_noisy, scan_warnings

_SPARSE = 0.5  # a larger share of samples above epsilon is worth a warning; derived: most of them


def sampling_warnings(shape: Shape, chosen: ChosenSamples) -> Iterator[str]:
    """Report what was left out, and where the samples are too sparse to trust the axis; a sentence each."""
    samples, density = chosen.samples, chosen.samples.density
    if chosen.thinned:
        yield chosen.thinned
    yield from scan_warnings(chosen.scan, chosen.sides.source)
    yield from reading_warnings(shape)
    if rounded := rounding_warning(shape, samples.spacing, "samples are apart by"):
        yield Severe(rounded)
    on_faces = chosen.sampling is not SamplingMode.VERTICES
    if on_faces and shape.of_samples and (loose := shape.loose_vertices):
        yield (
            f"{loose:,} vertices without a face were left out; choose Sampling Vertices to use them"
        )
    if samples.buried:
        yield (
            f"{samples.buried:,} samples were left out because the surface there bounds nothing: "
            "overlapping parts, walls inside, or sheets or gaps without thickness"
        )
    walls = samples.walls
    if walls is not None and walls.are_missed:
        yield Severe(
            f"at {percent(walls.missed)} of the surface the walls are closer to each other, about "
            f"{walls.thickness:.2g}, than the samples, so the inner axis is missing or torn there; "
            "more samples, a smaller Spacing or a larger Budget help"
        )
    if chosen.differs:
        yield differs_warning(shape, chosen)
    # Near sharp edges every sample is above any epsilon, however right the axis is; so rays from the faces decide where
    # they can.
    is_confirmed = on_faces and walls is not None and not walls.are_missed
    if density.share > _SPARSE and not is_confirmed and not is_noisy(chosen.scan):
        yield (
            f"{percent(density.share)} of the samples are too sparse for what the shape has there "
            f"(epsilon above {density.limit:g}), so the axis may be wrong; Report Sampling shows where"
        )


def differs_warning(shape: Shape, chosen: ChosenSamples) -> str:
    """Say that the samples have another topology than the faces, and why."""
    return _crossing(shape) if len(shape.crossing) else _differs(chosen)


def _crossing(shape: Shape) -> str:
    """Where faces pass through each other, as closed faces of a solid do not."""
    pair = shape.crossing[:1]
    place = placed(shape.points[shape.triangles[pair[0, 0]]].mean(axis=0)[None], shape.frame)[0]
    pairs = counted(len(shape.crossing), "pair")
    return (
        f"{pairs} of faces pass through each other, as near {words_of_place(place)}, so the "
        "pieces, loops and cavities of the faces are not those of a solid; a Boolean modifier with "
        "Self Intersection, or Remesh, makes one surface of them"
    )


def _differs(chosen: ChosenSamples) -> str:
    count, worst = len(chosen.samples.points), chosen.worst
    where = (
        f", most of all near {worst.words}, where they are {worst.apart:.2g} apart" if worst else ""
    )
    return (
        "the axis has not as many pieces, loops and cavities as the faces, although "
        f"{count:,} samples were taken: details, gaps or folds of the faces are smaller than "
        f"their spacing{where}; a larger Budget or Merge by Distance may help"
    )
