# SPDX-License-Identifier: GPL-3.0-or-later
"""How far limbs reach, and where they end.

In a blunt end of a limb the axis is a sheet, of which the curve goes through any part: it stops short, or runs into a
corner. What does not depend on that are the balls of the samples that the limb owns. They say how far it reaches; and
its end is the largest of those that reach as far as any.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .net import Net

_AS_FAR = 0.25  # of its radius: a ball that reaches so little less than another one reaches as far
_LAST = 2.0  # radii: how much of a limb is its end
_STEP = 0.5  # radii between the points of what is added to it


@dataclass(frozen=True, eq=False)
class Balls:
    """The largest ball at each sample that has one, in the order of the points of the curve that own the samples.

    Parameters
    ----------
    centre : (n, 3) float64
    radius : (n,) float64
    sample : (n,) int64
        Which touches each.
    first : (p + 1,) int64
        Those of point i are the rows first[i] : first[i + 1].
    """

    centre: NDArray[np.float64]
    radius: NDArray[np.float64]
    sample: NDArray[np.int64]
    first: NDArray[np.int64]

    def of(self, points: list[int]) -> NDArray[np.int64]:
        """The rows of the balls of some points."""
        starts, ends = self.first[points], self.first[np.array(points, np.int64) + 1]
        counts = ends - starts
        before = np.cumsum(counts) - counts
        return np.arange(int(counts.sum())) + np.repeat(starts - before, counts)


def balls_of(
    owner: NDArray[np.int64],
    centre: NDArray[np.float64],
    radius: NDArray[np.float64],
    sample: NDArray[np.int64],
    count: int,
) -> Balls:
    """The balls of samples, which are rows of the same length; `count` points own them."""
    order = np.argsort(owner, kind="stable")
    first = np.zeros(count + 1, np.int64)
    np.cumsum(np.bincount(owner, minlength=count), out=first[1:])
    return Balls(centre[order], radius[order], sample[order], first)


def reach_of(net: Net, name: int, balls: Balls) -> float:
    """How far a leaf, with all that it owns, reaches from the centre of its fork."""
    chain = net.from_fork(name)
    rows = balls.of(net.held(chain[1:]))
    far = _reaches(balls, rows, net.points[chain[0]])
    tip = np.linalg.norm(net.points[chain[-1]] - net.points[chain[0]]) + net.radius[chain[-1]]
    return float(far.max()) if len(rows) else float(tip)


def _reaches(
    balls: Balls, rows: NDArray[np.int64], base: NDArray[np.float64]
) -> NDArray[np.float64]:
    """How far balls reach from a point in the direction in which their centres lie in the mean."""
    away = balls.centre[rows] - base
    along = away.sum(axis=0)
    length = max(float(np.linalg.norm(along)), float(np.finfo(float).tiny))
    return away @ (along / length) + balls.radius[rows]


def end_limbs(net: Net, owner: NDArray[np.int64], balls: Balls) -> NDArray[np.int64]:
    """Let each limb end where it does.

    Parameters
    ----------
    net : Net
        Its tips move. Points are added where a limb goes on beyond its tip.
    owner : (n,) int64
        The point that owns each sample.
    balls : Balls

    Returns
    -------
    owner : (n,) int64
        Samples of a tip belong to the nearest of the points that were added to it.
    """
    owner = owner.copy()
    for tip in net.tips():
        _end(net, tip, owner, balls)
    return owner


def _end(net: Net, tip: int, owner: NDArray[np.int64], balls: Balls) -> None:
    (name,) = net.at[tip]
    chain = net.branches[name]
    chain = chain if chain[-1] == tip else chain[::-1]
    start = _start_of_end(net, chain)
    rows = balls.of(net.held(chain[start + 1 :]))
    if not len(rows):
        return
    far = _reaches(balls, rows, net.points[chain[start]])
    as_far = rows[far >= far.max() - _AS_FAR * balls.radius[rows]]
    best = as_far[np.argmax(balls.radius[as_far])]
    _lead_to(net, name, chain, start, balls.centre[best], float(balls.radius[best]))


def _start_of_end(net: Net, chain: list[int]) -> int:
    """The last point of a chain, but for its tip, from which the tip is farther than two of its radii; or the first."""
    away = np.linalg.norm(net.points[chain[:-1]] - net.points[chain[-1]], axis=1)
    far = np.flatnonzero(away > _LAST * net.radius[chain[:-1]])
    return int(far[-1]) if len(far) else 0


def _lead_to(
    net: Net, name: int, chain: list[int], start: int, place: NDArray[np.float64], radius: float
) -> None:
    """Let the tip of a chain be at another place, to which it goes straight from the nearest of its last points."""
    away = np.linalg.norm(net.points[chain[start:-1]] - place, axis=1)
    kept = start + int(np.argmin(away))
    net.end_at(name, chain[: kept + 1], chain[-1])
    net.points[chain[-1]], net.radius[chain[-1]] = place, radius
