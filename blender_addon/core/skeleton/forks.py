# SPDX-License-Identifier: GPL-3.0-or-later
"""This module moves forks to the points where their limbs would meet.

The ball at a fork covers the roots of its limbs. Inside it the axis hardly shows the directions of the limbs, and its
curve is arbitrary. So the limbs outside the ball are extended as straight lines, and the fork moves to the point where
they meet. If that point is not well inside the ball, nothing changes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..curves.net import Net
from ..small_matrices import dot, inverse, stretches, times

_FAR = 2.5  # points of a limb count up to this distance from the fork, in radii of its ball; chosen: skeleton
_ROOM = 0.6  # of the radius: the ball at the new place must have as much; chosen: skeleton
_STAY = 0.05  # the old place has this weight; each limb has weight 1; chosen: skeleton


@dataclass(frozen=True, eq=False)
class _Root:
    """A root begins a branch: `inside` are its points in the ball of its fork, `beyond` is the first one outside."""

    inside: list[int]
    beyond: int


def draw_forks(net: Net, samples: Floats) -> None:
    """Move the forks of a net and the points in their balls; each new radius is the distance to the nearest sample."""
    forks = [node for node, names in net.at.items() if len(names) > 2]
    if forks:
        _draw(net, forks, samples)
        _draw(
            net, forks, samples
        )  # the points outside the ball change as the fork moves, so a second pass is needed


def _draw(net: Net, forks: list[int], samples: Floats) -> None:
    wanted = np.array([_meeting_point(net, fork) for fork in forks])
    room = _room(wanted, samples)
    moved = np.linalg.norm(wanted - net.points[forks], axis=1)
    fits = (moved <= net.radius[forks]) & (room >= _ROOM * net.radius[forks])
    roots = {fork: _roots(net, fork) for fork, fit in zip(forks, fits, strict=True) if fit}
    changed = []
    for fork, place in zip(forks, wanted, strict=True):
        for root in roots.get(fork, ()):
            _straighten(net, root, place)
            changed += root.inside
        if fork in roots:
            net.points[fork] = place
            changed.append(fork)
    if changed:
        net.radius[changed] = _room(net.points[changed], samples)


def _meeting_point(net: Net, fork: int) -> Floats:
    """Return the point that is nearest in least squares to the lines along the limbs."""
    here = net.points[fork]
    matrix, right = _STAY * np.eye(3), np.zeros(3)
    for name in net.at[fork]:
        outside = _outside(net, name, fork)
        if len(outside) > 1:
            middle, along = _line(net.points[outside] - here)
            across = np.eye(3) - np.outer(along, along)
            matrix, right = matrix + across, right + times(middle, across)
    return here + times(right, inverse(matrix))


def _outside(net: Net, name: int, fork: int) -> list[int]:
    """Return the points of a branch outside but near the ball of its fork; only its first half if it ends in a fork."""
    chain = _from(net, name, fork)
    if len(net.at[chain[-1]]) > 2:
        chain = chain[: len(chain) // 2 + 1]
    away = np.linalg.norm(net.points[chain] - net.points[fork], axis=1) / net.radius[fork]
    first = next((i for i, far in enumerate(away) if far > 1.0), len(chain))
    last = next((i for i in range(first, len(chain)) if away[i] > _FAR), len(chain))
    return chain[first:last]


def _from(net: Net, name: int, fork: int) -> list[int]:
    chain = net.branches[name]
    return chain if chain[0] == fork else chain[::-1]


def _line(points: Floats) -> tuple[Floats, Floats]:
    """Return the mean of points, and the direction in which they spread most."""
    middle = points.mean(axis=0)
    return middle, stretches(points - middle)[1][0]


def _roots(net: Net, fork: int) -> list[_Root]:
    """Return the branches that leave the ball of a fork; a loop leaves it twice."""
    found = []
    for name in dict.fromkeys(net.at[fork]):
        chain = net.branches[name]
        ways = [chain, chain[::-1]] if chain[0] == chain[-1] else [_from(net, name, fork)]
        for way in ways:
            away = np.linalg.norm(net.points[way] - net.points[fork], axis=1)
            out = next((i for i, far in enumerate(away) if far > net.radius[fork]), len(way) - 1)
            out = min(out, len(way) // 2) if len(net.at[way[-1]]) > 2 else out
            found.append(_Root(way[1:out], way[out]))
    return found


def _straighten(net: Net, root: _Root, place: Floats) -> None:
    """Space the points in the ball evenly on the segment from its new centre to the next point."""
    count = len(root.inside)
    share = np.arange(1, count + 1)[:, None] / (count + 1)
    net.points[root.inside] = (1.0 - share) * place + share * net.points[root.beyond]


def _room(points: Floats, samples: Floats) -> Floats:
    """Return the distance to the nearest sample, (n,); there are few points, and they are far from all samples."""
    centred = samples - samples.mean(axis=0)
    squares = dot(centred, centred)
    found = np.empty(len(points))
    for start in range(0, len(points), 64):
        some = points[start : start + 64]
        row = (squares - 2.0 * times(some - samples.mean(axis=0), centred)).argmin(axis=1)
        found[start : start + 64] = np.linalg.norm(some - samples[row], axis=1)
    return found
