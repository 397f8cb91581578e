# SPDX-License-Identifier: GPL-3.0-or-later
"""The warnings about a skeleton, a sentence each."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..samples.chosen import ChosenSamples
    from .rules import Loops


def skeleton_warnings(chosen: ChosenSamples, loops: Loops, sheets: int) -> list[str]:
    """Sentences, the most important first.

    Parameters
    ----------
    chosen : ChosenSamples
    loops : Loops
        What became of the small ones.
    sheets : int
        Facets of closed sheets, which have no curve.
    """
    found = []
    if chosen.thinned:
        found.append(chosen.thinned)
    if sheets:
        found.append(
            f"{sheets:,} facets of the axis are closed sheets round cavities, which have no curve; fill the cavities"
        )
    if loops.cut:
        found.append(
            f"{loops.cut:,} loops were cut where the solid touches itself; if some of them are meant, "
            "take more samples"
        )
    if loops.filled:
        found.append(f"{loops.filled:,} loops round pinholes were filled")
    return found
