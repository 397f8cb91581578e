# SPDX-License-Identifier: GPL-3.0-or-later
"""The balls or capsules of one link of a robot: so many, or as few as keep within a length."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..cover.ball_cover import BallCover, Balls, cover_by_balls
from ..cover.tight_capsules import Capsules
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import BallSettings, CoverMode, Settings
from ..shape.shape import Shape
from ..small_matrices import length_of


@dataclass(frozen=True)
class LinkSettings:
    """Each link gets at most so many balls or capsules, and with a tolerance above 0 as few as keep within it."""

    balls: BallSettings
    tolerance: float = 0.0


def error_of(balls: Balls) -> float:
    """Return how far they reach out of the solid that they hold, or INSIDE, how far its surface is from them."""
    return balls.outside if balls.mode is CoverMode.AROUND else balls.farthest


def volume_of(balls: Balls) -> float:
    """Return the volume of the union: exactly for one ball or capsule, for more as counted on a lattice."""
    alone = balls.single
    rows = np.concatenate([balls.edges, np.column_stack([alone, alone])])
    ends, radii = balls.centres[rows], balls.radii[rows]
    if len(rows) > 1:
        return Capsules(ends, radii).volume()
    radius = float(radii[0, 0])
    return math.pi * radius * radius * (length_of(ends[0, 1] - ends[0, 0]) + radius * 4 / 3)


def cover_link(
    shape: Shape, settings: Settings, wanted: LinkSettings, progress: Progress, limit: MemoryLimit
) -> BallCover:
    """Cover a link; with a tolerance by the first of 1, 2, 4, ... shapes that keep it, or by the closest of all."""

    def cover(count: int) -> BallCover:
        return cover_by_balls(shape, settings, replace(wanted.balls, count=count), progress, limit)

    most = wanted.balls.count
    if not wanted.tolerance > 0.0:
        return cover(most)
    count, best = 1, cover(1)
    while error_of(best.balls) > wanted.tolerance and count < most:
        count = min(2 * count, most)
        best = min(best, cover(count), key=lambda one: error_of(one.balls))
    return best
