# SPDX-License-Identifier: GPL-3.0-or-later
"""The verdict on a computation: good, to be looked at, or probably wrong, and the most important sentence."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from ..settings import SamplingMode
from ..severe import Severe

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..samples.chosen import ChosenSamples


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
