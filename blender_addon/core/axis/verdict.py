# SPDX-License-Identifier: GPL-3.0-or-later
"""The verdict on a computation: good, to be looked at, or probably wrong, and the most important sentence."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from ..errors import Severe
from ..samples.chosen import ChosenSamples
from ..settings import SamplingMode

# A few words for the panel, by a part of the sentence that they stand for.
_IN_SHORT = {
    "looked inward and were read": "Faces looked inward",
    "lie on another face": "Double faces left out",
    "are sheets without thickness": "Sheets left out",
    "the surface there bounds nothing": "Inner faces left out",
    "vertices without a face": "Loose points left out",
    "the walls are closer to each other": "Thin walls are torn",
    "not as many pieces, loops": "Small details are lost",
    "are too sparse for what": "Samples are too few",
    "the surface is open at": "Openings were closed",
    "bound nothing, so their points": "Faces close no solid",
    "the points enclose nothing": "Points close no solid",
    "the normals point inward": "Normals point inward",
    "no ball fits between the faces": "Faces overlap",
    "not on the surface that Tight Cocone": "Some points are noise",
    "Tight Cocone found touches itself": "Surface touches itself",
    "Tight Cocone closed openings": "Openings are a guess",
    "so inner and outer facets mean little": "Points close no solid",
    "not on the surface that the poles": "Some points are noise",
    "surface that the poles tell has": "Openings are a guess",
    "stood alone and were left out": "Lone points left out",
    "stand alone: outliers": "There are lone points",
    "the surface ends at": "The scan has openings",
    "do not tell one solid": "Inside is a guess",
    "the points lie in two layers": "Read as a thin wall",
    "too much for so many points": "Too much noise",
    "the points were moved by": "Noise was smoothed",
    "their vertices were moved by": "Faces were smoothed",
    "spacings were found in the faces": "Faces have noise",
    "the faces are sides of cubes": "Faces are cubes",
    "found and left as it is": "There is noise",
    "the points lie in layers": "Points lie in layers",
    "the scans do not fit": "Scans do not fit",
}
_COUNTED = re.compile(r"(?:Sampled|Used the) ([\d,]+) (points|vertices)")


class Light(Enum):
    """The colour of the traffic light."""

    GOOD = "GOOD"
    LOOK = "LOOK"
    WRONG = "WRONG"


@dataclass(frozen=True)
class Verdict:
    light: Light
    sentence: str


def verdict(chosen: ChosenSamples, warnings: Sequence[str]) -> Verdict:
    """Choose the first severe warning, or else the first warning, or else the description of the samples.

    Parameters
    ----------
    chosen : ChosenSamples
    warnings : sequence of str
    """
    for warning in warnings:
        if isinstance(warning, Severe):
            return Verdict(Light.WRONG, _as_sentence(warning))
    if warnings:
        return Verdict(Light.LOOK, _as_sentence(warnings[0]))
    return Verdict(Light.GOOD, plainly(chosen))


def in_short(sentence: str) -> str:
    """A few words for the sentence of a verdict; its beginning, where none are known."""
    for part, words in _IN_SHORT.items():
        if part.lower() in sentence.lower():
            return words
    if counted := _COUNTED.match(sentence):
        count, kind = counted.groups()
        return f"{count} vertices" if kind == "vertices" else f"{count} samples"
    return re.split(r"[;:(] ?", sentence)[0].strip().rstrip(".")


def plainly(chosen: ChosenSamples) -> str:
    """Describe the analysed samples and the reason for them, in everyday words."""
    count = len(chosen.samples.points)
    if chosen.sampling is SamplingMode.VERTICES:
        return f"Used the {count:,} vertices as they are."
    if chosen.sparse:
        return f"Sampled {count:,} points, because the mesh has too few vertices."
    return f"Sampled {count:,} points of the surface."


def _as_sentence(text: str) -> str:
    return text[0].upper() + text[1:] + ("" if text.endswith(".") else ".")
