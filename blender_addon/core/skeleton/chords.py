# SPDX-License-Identifier: GPL-3.0-or-later
"""This module keeps the edges of a skeleton inside of the solid.

The ball around a place, as large as its distance to the surface, lies on one side of it. So an edge that starts inside
stays inside if such balls around places along it cover it. An edge that they do not cover gets more points.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..arrays import Flags, Floats, Longs
from ..curves.depth import Depth
from ..curves.net import Net
from ..portable_angle import cosine
from ..small_matrices import dot, length_of

_HALVED = 8  # an edge that balls at so fine places do not cover touches the surface
# Balls on two sides of the surface may touch, and by rounding seem to overlap; balls overlap by more than this share.
_OVERLAP = 1e-6  # derived: rounding
_ROUNDS = 4  # so often an edge between neighbours is split
_TRIED = 14, 12  # steps and directions in which a place between two balls is looked for


def leave(ends: Floats, radius: Floats, depth: Depth) -> Flags:
    """Return which segments, (n, 2, 3), the balls do not cover; `radius`, (n, 2), is that of the balls at the ends."""
    bare = np.zeros(len(ends), bool)
    row = np.arange(len(ends))
    for _ in range(_HALVED):
        apart = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        open_ = apart >= (1.0 - _OVERLAP) * radius.sum(axis=1)
        ends, radius, row = ends[open_], radius[open_], row[open_]
        if not len(row):
            return bare
        middle = ends.mean(axis=1)
        room = depth(middle)
        ends = np.concatenate(
            [np.stack((ends[:, side], middle), axis=1) for side in (0, 1)], axis=0
        )
        radius = np.concatenate([np.column_stack((radius[:, side], room)) for side in (0, 1)])
        row = np.concatenate((row, row))
    bare[row] = True
    return bare


def kept_inside(points: Floats, radius: Floats, kept: Longs, depth: Depth) -> Longs:
    """Return the kept points of a chain and, where the way between two of them leaves the solid, those between."""
    while True:
        pairs = np.column_stack((kept[:-1], kept[1:]))
        pairs = pairs[np.diff(pairs, axis=1)[:, 0] > 1]
        pairs = pairs[leave(points[pairs], radius[pairs], depth)]
        if not len(pairs):
            return kept
        kept = np.union1d(kept, pairs.sum(axis=1) // 2)


def keep_inside(net: Net, depth: Depth) -> int:
    """Add points to a net where the way between two neighbours leaves the solid; radii are distances to the surface.

    A way to a tip may instead begin at an earlier point of its branch.

    Returns
    -------
    outside : int
        This many edges still leave it: no ball between their ends overlaps those at both.
    """
    edges = [(name, *pair) for name, chain in net.branches.items() for pair in pairwise(chain)]
    lost: list[tuple[int, int, int]] = []
    for _ in range(_ROUNDS):
        edges, missed = _split(net, edges, depth)
        lost += missed
    lost += _leaving(net, edges, depth)
    return sum(not _turned_back(net, edge, depth) for edge in lost)


def _split(
    net: Net, edges: list[tuple[int, int, int]], depth: Depth
) -> tuple[list[tuple[int, int, int]], list[tuple[int, int, int]]]:
    """Split the edges that leave the solid, and return the halves, and those that cannot be split."""
    halves, lost = [], []
    for name, a, b in _leaving(net, edges, depth):
        place = _between(net.points[[a, b]], net.radius[[a, b]], depth)
        if place is None:
            lost.append((name, a, b))
            continue
        at = list(pairwise(net.branches[name])).index((a, b)) + 1
        middle = net.insert(name, at, place, float(depth(place[None])[0]))
        halves += [(name, a, middle), (name, middle, b)]
    return halves, lost


def _turned_back(net: Net, edge: tuple[int, int, int], depth: Depth) -> bool:
    """Lead a branch to its tip from the last point from which the way stays inside; its first half stays.

    Returns whether the edge is gone. A branch may have passed a crease before it ended on the other side.
    """
    name, *ends = edge
    chain = net.branches[name]
    if not set(ends) <= set(chain):
        return True
    tip = next((node for node in net.ends_free(name) if node in ends), None)
    if tip is None:
        return False
    _, chain = net.limb(tip)
    rows = np.array(chain[len(chain) // 2 : -1][::-1], np.intp)
    to_tip = np.column_stack((rows, np.full(len(rows), tip)))
    inside = np.flatnonzero(~leave(net.points[to_tip], net.radius[to_tip], depth))
    if not len(inside):
        return False
    net.end_at(name, chain[: chain.index(rows[inside[0]]) + 1], tip)
    return True


def _leaving(
    net: Net, edges: list[tuple[int, int, int]], depth: Depth
) -> list[tuple[int, int, int]]:
    rows = np.array([ends for _, *ends in edges], np.intp).reshape(-1, 2)
    bad = leave(net.points[rows], net.radius[rows], depth)
    return [edges[i] for i in np.flatnonzero(bad)]


def _between(ends: Floats, radius: Floats, depth: Depth) -> Floats | None:
    """Return the place whose ball overlaps those at two ends most, or None if no ball overlaps both.

    Only the ball of a place inside overlaps balls inside.
    """
    steps, count = _TRIED
    size = length_of(ends[1] - ends[0])
    ways = _even_directions(count)
    best = ends.mean(axis=0)
    value = -np.inf
    for _ in range(steps):
        tried = np.concatenate((best[None], best + size * ways))
        size *= 0.7
        away = np.linalg.norm(tried[:, None] - ends[None], axis=2)
        overlap = (depth(tried)[:, None] + radius - away).min(axis=1)
        if overlap.max() > value:
            best, value = tried[overlap.argmax()], overlap.max()
    return best if value > 0.0 else None


def _even_directions(count: int) -> Floats:
    """Return unit vectors that are spread evenly, (count, 3): a spiral with steps of the golden angle."""
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    turn = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(count)
    across = np.sqrt(1.0 - height**2)
    return np.column_stack((across * cosine(turn), across * cosine(turn - np.pi / 2), height))


def kept_points(points: Floats, tolerance: Floats) -> Longs:
    """Return the points of a chain that are kept, ascending, by the rule of Douglas and Peucker (1973).

    They include its ends, and no other point is farther than its tolerance from the chain of the kept points.

    The dimension of the (n, k) points is arbitrary, and each has a tolerance, (n,). The first and last points of a
    closed chain are equal.
    """
    last = len(points) - 1
    kept, left = {0, last}, [(0, last)]
    while left:
        first, end = left.pop()
        if end - first < 2:
            continue
        inner = slice(first + 1, end)
        excess = _distance(points[inner], points[first], points[end]) / tolerance[inner]
        worst = int(np.argmax(excess))
        if excess[worst] > 1.0:
            kept.add(first + 1 + worst)
            left += [(first, first + 1 + worst), (first + 1 + worst, end)]
    if last > 2 and np.array_equal(points[0], points[last]) and len(kept) < 4:
        kept |= {last // 3, 2 * last // 3}  # a loop must not collapse to a line
    return np.array(sorted(kept), np.int64)


def _distance(points: Floats, a: Floats, b: Floats) -> Floats:
    """Return the distances from points to a segment."""
    along = b - a
    square = float(dot(along, along))
    share = (
        np.clip(dot(points - a, along) / square, 0.0, 1.0)
        if square > 0.0
        else np.zeros(len(points))
    )
    return np.linalg.norm(points - a - share[:, None] * along, axis=1)
