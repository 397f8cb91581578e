# SPDX-License-Identifier: GPL-3.0-or-later
"""This module decides how far limbs reach, and where they end.

In a blunt end of a limb the axis is a sheet, and the curve may run through any part of it: it stops short, or runs into
a corner. The balls of the samples that the limb owns do not depend on that. They determine how far the limb reaches; it
ends at the largest of the balls that reach farthest. What lies beyond the last of them leads into the corner between an
opening and the surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Longs
from ..small_matrices import dot, length_of
from .net import Net

_AS_FAR = 0.25  # of its radius: a ball less short reaches farthest; chosen: skeleton
LAST = 2.0  # radii: the end of a limb, and closer ends mean its tip; chosen: skeleton


@dataclass(frozen=True, eq=False)
class Balls:
    """These are the largest balls at the samples, sorted by the points of the curve that own the samples.

    Parameters
    ----------
    centre : (n, 3) float64
    radius : (n,) float64
    sample : (n,) int64
        The sample that touches each ball.
    first : (p + 1,) int64
        The balls of point i are the rows first[i] : first[i + 1].
    """

    centre: Floats
    radius: Floats
    sample: Longs
    first: Longs

    def of(self, points: list[int]) -> Longs:
        """Return the rows of the balls of some points."""
        starts, ends = self.first[points], self.first[np.array(points, np.int64) + 1]
        counts = ends - starts
        before = np.cumsum(counts) - counts
        return np.arange(int(counts.sum())) + np.repeat(starts - before, counts)


def balls_of(owner: Longs, centre: Floats, radius: Floats, sample: Longs, count: int) -> Balls:
    """Return the balls sorted by owner. All arrays have one row for each ball; `count` points may own them."""
    order = np.argsort(owner, kind="stable")
    first = np.zeros(count + 1, np.int64)
    np.cumsum(np.bincount(owner, minlength=count), out=first[1:])
    return Balls(centre[order], radius[order], sample[order], first)


def reach_of(net: Net, name: int, balls: Balls) -> float:
    """Return how far a leaf and the balls of its samples reach from the centre of its fork."""
    chain = net.from_fork(name)
    rows = balls.of(net.held(chain[1:]))
    far = _reaches(balls, rows, net.points[chain[0]])
    tip = length_of(net.points[chain[-1]] - net.points[chain[0]]) + net.radius[chain[-1]]
    return float(far.max()) if len(rows) else float(tip)


def _reaches(balls: Balls, rows: Longs, base: Floats) -> Floats:
    """Return how far balls reach from a point in the mean direction of their centres."""
    away = balls.centre[rows] - base
    along = away.sum(axis=0)
    far = max(length_of(along), float(np.finfo(float).tiny))
    return dot(away, along / far) + balls.radius[rows]


def end_limbs(net: Net, owner: Longs, balls: Balls, tips: list[int] | None = None) -> Longs:
    """Move the end of each limb to its largest ball that reaches farthest, and return a copy of the owners of samples.

    The last points of a limb are replaced by a straight way to the new tip. All tips move unless some are given.
    """
    owner = owner.copy()
    for tip in net.tips() if tips is None else tips:
        _end(net, tip, owner, balls)
    return owner


def _end(net: Net, tip: int, owner: Longs, balls: Balls) -> None:
    name, chain = net.limb(tip)
    last = next(
        (at for at in range(len(chain))[:0:-1] if len(balls.of(net.held(chain[at : at + 1])))), 0
    )
    if not last:
        return
    start = _start_of_end(net, chain[: last + 1])
    rows = balls.of(net.held(chain[start + 1 :]))
    far = _reaches(balls, rows, net.points[chain[start]])
    as_far = rows[far >= far.max() - _AS_FAR * balls.radius[rows]]
    best = as_far[np.argmax(balls.radius[as_far])]
    _lead_to(net, name, chain, start, balls.centre[best], float(balls.radius[best]))


def _start_of_end(net: Net, chain: list[int]) -> int:
    """Return the last position on a chain that is more than two of its radii away from the tip, or 0."""
    away = np.linalg.norm(net.points[chain[:-1]] - net.points[chain[-1]], axis=1)
    far = np.flatnonzero(away > LAST * net.radius[chain[:-1]])
    return int(far[-1]) if len(far) else 0


def _lead_to(
    net: Net, name: int, chain: list[int], start: int, place: Floats, radius: float
) -> None:
    """Move the tip of a chain, and lead the chain straight to it from the nearest of the points after `start`."""
    away = np.linalg.norm(net.points[chain[start:-1]] - place, axis=1)
    kept = start + int(np.argmin(away))
    net.end_at(name, chain[: kept + 1], chain[-1])
    net.points[chain[-1]], net.radius[chain[-1]] = place, radius
