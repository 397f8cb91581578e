# SPDX-License-Identifier: GPL-3.0-or-later
"""Each warning about a skeleton is one sentence."""

from __future__ import annotations

from ..curves.rules import Loops
from ..samples.density import percent
from .fill import Filled


def skeleton_warnings(loops: Loops, sheets: int, outside: int, joined: int = 0) -> list[str]:
    """Return the warnings, the most important first.

    They count loops that were cut and filled, facets of closed sheets, which have no curve, edges that leave the solid,
    and pieces that were joined to others.
    """
    found = []
    if sheets:
        found.append(
            f"{sheets:,} facets of the axis are closed sheets round cavities, which have no curve; fill the cavities"
        )
    if outside:
        found.append(
            f"{outside:,} edges of the skeleton leave the solid, where it is thinner than their ends are apart; "
            "take more samples"
        )
    if joined:
        found.append(
            f"{joined:,} pieces of the skeleton were joined to others across gaps that lie inside the solid, where "
            "samples are too few for it; take more samples"
        )
    if loops.cut:
        found.append(
            f"{loops.cut:,} loops were cut where the solid touches itself; if some of them are meant, "
            "take more samples"
        )
    if loops.filled:
        found.append(f"{loops.filled:,} loops round pinholes were filled")
    return found


def fill_warnings(full: Filled | None) -> list[str]:
    """Return what was filled, as a sentence; none where that was not asked for."""
    if full is None:
        return []
    if not len(full.inner):
        return ["nothing is hollow, so Fill changed nothing"]
    return [f"{percent(full.share)} of the faces lie inside of others, and were filled"]
