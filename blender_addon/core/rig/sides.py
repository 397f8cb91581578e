# SPDX-License-Identifier: GPL-3.0-or-later
"""This module finds the two sides of a body: the plane between them, the limbs in it, and the limbs that are a pair.

Two limbs are a pair if they are alike, leave the same place, or places that are a pair, and start as mirror images of
each other. Where they end does not matter, so a body in a pose has the same pairs. The plane goes through the root. It
is that across X if no other one is better, or across another axis, or aslant if more limbs have a partner.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Flags, Floats, Longs
from ..small_matrices import dot, length_of
from .joints import ERROR
from .tree import Chain

_ALIKE = 1.6  # lengths of like limbs outside their forks, and mean radii, differ by at most this factor; chosen: unseen
_STARTS = 0.75  # starts are mirror images up to this share of the radius of the ball at their fork; chosen: unseen
_ENOUGH = 0.5  # of the length that lies aside of the plane is in pairs; derived: most of it
_STRAIGHT = 0.5  # the weight of starts that are off, in radii, against limbs without a partner; chosen: unseen
_AS_GOOD = 0.1  # the plane across an axis is taken if it costs so little more than the best one; chosen: unseen
_ASLANT = 0.5  # a plane across no axis may cost this much of what others may; chosen: unseen
_TINY = float(np.finfo(float).tiny)


@dataclass(frozen=True, eq=False)
class Sides:
    """A body has two sides, or none that the shape shows."""

    # (3,) It points to the left side: its largest component is positive, so that left is positive X, as in Blender
    normal: Floats
    origin: Floats  # (3,) The plane goes through this point
    partner: Longs  # (c,) The chain that is the mirror image of each chain, or -1
    within: Flags  # (c,) The chain lies in the plane
    found: bool  # Whether the shape shows the plane; if not, it has neither pairs nor chains within

    def is_left(self, chain: Chain) -> bool:
        """Return whether a chain that has a partner is the left one of the two."""
        return bool(dot(_start(chain) - self.origin, self.normal) > 0.0)


def sides_of(tree: list[Chain]) -> Sides:
    """Return the sides of a body with the chains of a tree."""
    origin = tree[0].points[0]
    tried = [_paired(tree, normal, origin) for normal in _normals(tree)]
    tried += [_paired(tree, _between(tree, sides), origin) for sides in tried]
    costs = np.array([_cost(tree, sides) for sides in tried])
    costs[3:] /= _ASLANT
    upright = np.flatnonzero(costs[:3] <= costs.min() + _AS_GOOD)
    best = int(upright[0] if len(upright) else costs.argmin())
    return tried[best] if costs[best] < 1.0 else _none(tree, origin)


def _cost(tree: list[Chain], sides: Sides) -> float:
    """Return how bad a plane is: 0 if all is symmetric, 1 or more if there are too few pairs."""
    rows = np.flatnonzero(sides.partner >= 0)
    if not len(rows):
        return np.inf
    starts = np.array([_start(chain) for chain in tree])
    image = starts - 2.0 * dot(starts - sides.origin, sides.normal)[:, None] * sides.normal
    radius = np.array([chain.radius[0] for chain in tree])
    off = np.linalg.norm(starts[sides.partner[rows]] - image[rows], axis=1) / radius[rows]
    length = np.array([chain.length for chain in tree])
    aside = ~sides.within
    alone = length[aside & (sides.partner < 0)].sum() / max(length[aside].sum(), _TINY)
    return float(alone / (1.0 - _ENOUGH) + _STRAIGHT * off.mean())


def _between(tree: list[Chain], sides: Sides) -> Floats:
    """Return the normal of the plane halfway between the starts of all pairs, or the same one if there are none."""
    rows = [row for row in np.flatnonzero(sides.partner >= 0) if sides.is_left(tree[row])]
    across = [_start(tree[row]) - _start(tree[sides.partner[row]]) for row in rows]
    if not across:
        return sides.normal
    return _signed(np.sum(across, axis=0))


def _signed(normal: Floats) -> Floats:
    """Return a vector with length 1 and a positive largest component."""
    normal = normal / max(length_of(normal), _TINY)
    return normal * np.sign(normal[np.argmax(np.abs(normal))])


def _none(tree: list[Chain], origin: Floats) -> Sides:
    count = len(tree)
    return Sides(np.eye(3)[0], origin, np.full(count, -1), np.zeros(count, bool), False)


def _normals(tree: list[Chain]) -> list[Floats]:
    """Return the normals to try: the axes, then those between the starts of two like limbs of one fork."""
    found = list(np.eye(3))
    for a, first in enumerate(tree):
        for second in tree[a + 1 :]:
            if first.parent == second.parent and _alike(first, second):
                found.append(_signed(_start(first) - _start(second)))
    return found


def _alike(a: Chain, b: Chain) -> bool:
    (short, thin), (long, thick) = np.sort([_outside(a), _outside(b)], axis=0)
    return a.to_tip == b.to_tip and bool(long <= _ALIKE * short and thick <= _ALIKE * thin)


def _outside(chain: Chain) -> tuple[float, float]:
    """Return the length of a chain outside the ball at its start, and the mean radius there."""
    begin = min(chain.rim, chain.length / 2)
    radius = chain.at(np.linspace(begin, chain.length, 9))[1]
    return chain.length - begin, float(radius.mean())


def _start(chain: Chain) -> Floats:
    """Return the place where a chain leaves the balls at its fork."""
    return chain.at(np.array([chain.rim]))[0][0]


def _paired(tree: list[Chain], normal: Floats, origin: Floats) -> Sides:
    count = len(tree)
    partner, within = np.full(count, -1), np.zeros(count, bool)
    starts = np.array([_start(chain) for chain in tree])
    height = dot(starts - origin, normal)
    image = starts - 2.0 * height[:, None] * normal
    leaves = _leaves(tree)
    for a, chain in enumerate(tree):
        off = np.linalg.norm(starts - image[a], axis=1)
        may = [
            b
            for b in range(count)
            if b != a
            and partner[b] < 0
            and height[a] * height[b] < 0.0
            and _parents_fit(leaves[a], leaves[b], partner, within)
            and off[b] <= _STARTS * max(chain.radius[0], tree[b].radius[0])
            and _alike(chain, tree[b])
        ]
        if may and partner[a] < 0:
            b = min(may, key=lambda other: off[other])
            partner[a], partner[b] = b, a
        if partner[a] < 0:
            away = np.abs(dot(chain.points - origin, normal))
            above = chain.parent < 0 or within[chain.parent]
            within[a] = above and away.mean() <= ERROR * chain.radius.mean()
    return Sides(normal, origin, partner, within, True)


def _leaves(tree: list[Chain]) -> list[int]:
    """Return the chain at whose end each chain starts, or -1; a chain within the ball at its start is passed over."""
    found: list[int] = []
    for chain in tree:
        parent = chain.parent
        apart = parent < 0 or tree[parent].length > tree[parent].radius.max()
        found.append(parent if apart else found[parent])
    return found


def _parents_fit(first: int, second: int, partner: Longs, within: Flags) -> bool:
    """Return whether two chains leave the same place in the plane, or places that are a pair."""
    if first < 0 or second < 0:
        return first == second
    return bool(within[first]) if first == second else bool(partner[first] == second)
