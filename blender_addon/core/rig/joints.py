# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints are placed along a chain so that its bones follow it best.

Of all ways to lay a number of bones between two ends, the one with the least sum of squares is taken: of deviations,
measured in the radius there, and of lengths, so that a straight chain gets bones of even length. No bone is shorter
than the balls at its ends.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Longs
from ..small_matrices import dot
from .tree import Chain

ERROR = 0.5  # a bone may deviate from its curve, or a chain from a plane, by this share of the radius; chosen: unseen
LONG = 10.0  # a bone is at most this many mean radii long, as forearms are; chosen: unseen
_THIN = 0.5  # a ball counts as no thinner than this share of the mean of the chain; chosen: rig
_STEPS, _MOST_STEPS = 48, 192  # joints are looked for at this many; 2, 3, 4, 6 and 8 divide them


def joints_of(chain: Chain, begin: float, count: int = 0) -> Floats:
    """Return the joints between bones, as lengths from the start of the chain, with both ends, ascending.

    The first bone starts at the length `begin`. The count is the number of bones, or as many as there is room for. If
    it is 0, it is the least with which no bone is too long or deviates by more than half the radius.
    """
    mean = float(chain.radius.mean())
    steps = _STEPS * int(np.clip(np.ceil((chain.length - begin) / (_STEPS * mean)), 1, 4))
    marks = np.linspace(begin, chain.length, steps + 1)
    points, radius, _ = chain.at(marks)
    radius = np.maximum(radius, _THIN * mean)
    deviation = _deviations(points, radius)
    length = np.linalg.norm(points[:, None] - points[None], axis=2)
    room = length >= np.maximum(radius[:, None], radius[None])
    long = length / (LONG * mean)
    best = np.array([0, steps])
    for bones in range(2, steps + 1):
        if bones > count and (count or _fits(best, deviation, long)):
            break
        found = _cheapest(np.where(room, deviation**2 + long**2, np.inf), bones)
        if found is None:
            break
        best = found
    return marks[best]


def _fits(joints: Longs, deviation: Floats, long: Floats) -> bool:
    rows = joints[:-1], joints[1:]
    return bool((deviation[rows] <= 1.0).all() and (long[rows] <= 1.0).all())


def _deviations(points: Floats, radius: Floats) -> Floats:
    """Return how far a bone from a point to a later one is off those between at most, (n, n), in allowed ones."""
    count = len(points)
    found = np.zeros((count, count))
    for start in range(count - 2):
        to = points[start + 2 :] - points[start]  # the ends of bones
        inner = points[start + 1 : -1] - points[start]
        square = np.maximum(dot(to, to), np.finfo(float).tiny)
        share = np.clip(dot(to[:, None], inner) / square[:, None], 0.0, 1.0)
        away = np.linalg.norm(inner[None] - share[:, :, None] * to[:, None], axis=2)
        away /= ERROR * radius[start + 1 : -1]
        found[start, start + 2 :] = np.where(np.tril(np.ones(away.shape, bool)), away, 0.0).max(
            axis=1
        )
    return found


def _cheapest(cost: Floats, bones: int) -> Longs | None:
    """Return the joints of a number of bones, (bones + 1,), that cost least, or None if there is no room for them."""
    count = len(cost)
    later = np.triu(np.ones(cost.shape, bool), 1)
    cost = np.where(later, np.round(cost, 9), np.inf)  # rounded, so that mirror images are alike
    total, came = cost[0].copy(), []
    for _ in range(bones - 1):
        through = total[:, None] + cost
        came.append(through.argmin(axis=0))
        total = through.min(axis=0)
    if not np.isfinite(total[-1]):
        return None
    joints = [count - 1]
    for before in reversed(came):
        joints.append(int(before[joints[-1]]))
    return np.array([0, *joints[::-1]])
