# SPDX-License-Identifier: GPL-3.0-or-later
"""Where forks lie.

The ball at a fork covers the roots of its limbs; in there the axis says little of where they come from, and its curve
takes any way. So the fork goes to where the limbs, as they are outside, would meet, and the ways to it are straight.
Where they do not meet well inside that ball, all stays as it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .net import Net

_FAR = 2.5  # radii of the ball: how far a limb says where it comes from
_MOVED = 1.0  # radii: a fork goes no farther
_ROOM = 0.6  # of the radius: there has to be so much at the new place
_STAY = 0.05  # weight of the old place beside those of the limbs


@dataclass(frozen=True, eq=False)
class _Root:
    """The beginning of a branch: its points in the ball of its fork, from the fork outwards, and the next."""

    inside: list[int]
    beyond: int


def draw_forks(net: Net, samples: NDArray[np.float64]) -> None:
    """Move the forks of a net, and the points between them and their limbs; their radii reach to the nearest sample."""
    forks = [node for node, names in net.at.items() if len(names) > 2]
    if forks:
        _draw(net, forks, samples)
        _draw(
            net, forks, samples
        )  # limbs near the new places are others than those near the old ones


def _draw(net: Net, forks: list[int], samples: NDArray[np.float64]) -> None:
    wanted = np.array([_meeting_point(net, fork) for fork in forks])
    room = _room(wanted, samples)
    moved = np.linalg.norm(wanted - net.points[forks], axis=1)
    fits = (moved <= _MOVED * net.radius[forks]) & (room >= _ROOM * net.radius[forks])
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


def _meeting_point(net: Net, fork: int) -> NDArray[np.float64]:
    """The point nearest to the lines along which the limbs come, in least squares."""
    here = net.points[fork]
    matrix, right = _STAY * np.eye(3), np.zeros(3)
    for name in net.at[fork]:
        outside = _outside(net, name, fork)
        if len(outside) > 1:
            middle, along = _line(net.points[outside] - here)
            across = np.eye(3) - np.outer(along, along)
            matrix, right = matrix + across, right + across @ middle
    return here + np.linalg.solve(matrix, right)


def _outside(net: Net, name: int, fork: int) -> list[int]:
    """The points of a branch outside the ball of its fork but near to it; in its first half if it ends in a fork."""
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


def _line(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The mean of points, and the direction in which they spread most."""
    middle = points.mean(axis=0)
    return middle, np.linalg.svd(points - middle)[2][0]


def _roots(net: Net, fork: int) -> list[_Root]:
    """The branches that leave the ball of a fork; a loop leaves it twice."""
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


def _straighten(net: Net, root: _Root, place: NDArray[np.float64]) -> None:
    """Lay the points in the ball evenly on the way from its new centre to the next point."""
    count = len(root.inside)
    share = np.arange(1, count + 1)[:, None] / (count + 1)
    net.points[root.inside] = (1.0 - share) * place + share * net.points[root.beyond]


def _room(points: NDArray[np.float64], samples: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n,) the distance to the nearest sample; there are few points, and they are far from all samples."""
    centred = samples - samples.mean(axis=0)
    squares = np.einsum("ij,ij->i", centred, centred)
    found = np.empty(len(points))
    for start in range(0, len(points), 64):
        some = points[start : start + 64]
        row = (squares - 2.0 * (some - samples.mean(axis=0)) @ centred.T).argmin(axis=1)
        found[start : start + 64] = np.linalg.norm(some - samples[row], axis=1)
    return found
