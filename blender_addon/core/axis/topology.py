# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of pieces, loops and cavities of an axis, in words, and whether the faces of the shape agree."""

from __future__ import annotations

from collections.abc import Sequence

from ..counted import counted
from ..samples.analysed import Analysed
from ..settings import OPTIONS, Form, SidesFrom
from .medial_axis import MedialAxis

_NAMES = ("piece", "pieces"), ("loop", "loops"), ("cavity", "cavities")


def topology_sentence(axis: MedialAxis, wanted: Form, samples: Analysed) -> str:
    """Describe the topology of an axis in a sentence.

    The axis has the topology of the solid that the samples enclose. Only where the count of the closed faces agrees
    does the sentence claim that this is the solid. For an axis as published the sentence explains why the axis does not
    have the wanted form, or is empty.

    The wanted form is that of the settings; the axis may have another one.
    """
    if axis.level is None:
        if wanted is Form.PUBLISHED:
            return ""
        name = OPTIONS["form"].items[wanted][0]
        return f"Form Raw: {name} is for the inner axis only"
    betti, by_faces = axis.level.betti, samples.by_faces
    if by_faces == betti:
        return f"{betti_words(betti)}, as the solid"
    if samples.analysis.sides_from.name == SidesFrom.POLES.name:
        return f"{betti_words(betti)}, as the poles tell, which is a guess"
    if axis.level.loops_left_out:
        return f"{betti_words(betti)}, with less detail than the samples show"
    sentence = f"{betti_words(betti)}, by the samples"
    if by_faces is None:
        return sentence
    return f"{sentence}; by its faces it would be {betti_words(by_faces)}: {_why(betti, by_faces, samples)}"


def betti_words(betti: tuple[int, int, int]) -> str:
    """Format Betti numbers as '1 piece, 5 loops, no cavity'."""
    named = zip(betti, _NAMES, strict=True)
    return ", ".join(counted(n, *names) if n else f"no {names[0]}" for n, names in named)


def betti_in_short(betti: Sequence[int]) -> list[str]:
    """Format those Betti numbers that are not 0 as '1 piece', '5 loops' and '1 cavity'."""
    return [counted(number, *names) for number, names in zip(betti, _NAMES, strict=True) if number]


def _why(betti: tuple[int, int, int], by_faces: tuple[int, int, int], samples: Analysed) -> str:
    torn = betti[0] > by_faces[0]  # which no overlap does
    overlap = samples.buried > 0 and by_faces[0] > 1  # a single body has no parts that do
    if overlap and torn:
        return "its parts overlap, and some are thinner than the spacing of the samples"
    if overlap:
        return "its parts overlap"
    if torn:
        return "some parts are thinner than the spacing of the samples"
    shape = None if samples.solid is None else samples.solid.shape
    if shape is not None and len(shape.crossing):
        return "faces pass through each other"
    if shape is not None and shape.is_folded:
        return (
            "faces fold back on each other, or walls or gaps are thinner than the spacing of the "
            "samples"
        )
    return "walls or gaps are thinner than the spacing of the samples"
