# SPDX-License-Identifier: GPL-3.0-or-later
"""This module joins pieces of a net where the gap between them lies in the solid.

Where an open body is thinner than its samples are apart, its axis is torn, and many pieces are single points.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Floats, Longs
from ..curves.depth import Depth
from ..curves.net import Net
from ..machine.native import own_errors
from ..shape.shape import Shape

_LEAST_STEP = 1e-5  # of a way: narrower gaps between bodies are not seen; derived: rounding
_STEPS = 256  # a way that needs more runs along a face
_CHUNK = 1 << 20  # distances at once; bounds the memory


def join_pieces(net: Net, depth: Depth, shape: Shape) -> tuple[int, Longs]:
    """Join pieces by straight branches that stay inside, the shortest first.

    A single point in the ball of another piece stands for nothing of its own: that piece takes over what it owns.

    Returns
    -------
    count : int
        So many pieces were joined, or taken over.
    joins : (k, 2) int64
        The points of the net that the new branches join.
    """
    piece = net.pieces()
    if len(set(piece.values())) < 2:
        return 0, no_joins()
    rows, of_row = _rows(net, piece)
    radius = depth(net.points[rows])
    pairs = _nearest_pairs(net.points[rows], radius, of_row)
    ends = net.points[rows[pairs]]
    apart = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    inside = _stay_inside(ends, depth, shape)
    order = np.argsort(apart - radius[pairs].sum(axis=1), kind="stable")
    joined = {int(one): int(one) for one in np.unique(of_row)}
    count, made = 0, []
    for k in order[inside[order]]:
        first, second = (_top(joined, int(of_row[row])) for row in pairs[k])
        if first != second:
            joined[max(first, second)] = min(first, second)
            a, b = (int(row) for row in rows[pairs[k]])
            if _join(net, a, b, apart[k], radius[pairs[k]]):
                made.append((a, b))
            count += 1
    return count, np.array(made, np.int64).reshape(-1, 2)


def no_joins() -> Longs:
    """Return an empty table of joins."""
    return np.empty((0, 2), np.int64)


def _stay_inside(ends: Floats, depth: Depth, shape: Shape) -> Flags:
    """Return which straight ways, (n, 2, 3), are in the solid all along.

    The winding number is the same in the whole ball that no face reaches. So a way is walked from ball to ball, and
    over faces that lie within the solid, as where parts of it overlap.
    """
    along = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(along, axis=1)
    done = np.zeros(len(ends))
    stays = np.zeros(len(ends), np.bool_)
    left = np.arange(len(ends))
    for _ in range(_STEPS):
        stays[left[done[left] >= 1.0]] = True
        left = left[done[left] < 1.0]
        if not len(left):
            break
        places = ends[left, 0] + done[left, None] * along[left]
        room = depth(places) / length[left]
        with own_errors() as module:
            winding = np.asarray(module.winding_number(places, shape.points, shape.triangles))
        on_face = room < 0.5 * _LEAST_STEP
        done[left] += np.maximum(room, _LEAST_STEP)
        left = left[on_face | (winding > 0.5)]
    return stays


def _top(joined: dict[int, int], piece: int) -> int:
    """Return the piece that stands for all that were joined with one."""
    while joined[piece] != piece:
        piece = joined[piece]
    return piece


def _rows(net: Net, piece: dict[int, int]) -> tuple[Longs, Longs]:
    """Return the points of all branches and the single points, ascending, and the piece of each."""
    of_row = {row: piece[chain[0]] for chain in net.branches.values() for row in chain} | piece
    rows = np.array(sorted(of_row), np.int64)
    return rows, np.array([of_row[row] for row in rows.tolist()], np.int64)


def _nearest_pairs(points: Floats, radius: Floats, piece: Longs) -> Longs:
    """Return, for each two pieces, the two points whose balls have the smallest gap, (k, 2)."""
    order = np.argsort(piece, kind="stable")
    starts = np.flatnonzero(np.diff(piece[order], prepend=-1))
    stops = [*starts[1:].tolist(), len(order)]
    pairs = []
    for number, (begin, stop) in enumerate(zip(starts.tolist(), stops[:-1], strict=False)):
        later = order[stop:]
        least, nearest = _nearest(points, radius, order[begin:stop], later)
        for first, last in zip(starts[number + 1 :] - stop, stops[number + 1 :], strict=True):
            row = first + int(least[first : last - stop].argmin())
            pairs.append((nearest[row], later[row]))
    return np.array(pairs, np.int64).reshape(-1, 2)


def _nearest(points: Floats, radius: Floats, rows: Longs, others: Longs) -> tuple[Floats, Longs]:
    """Return the least gap between the ball of each of the others and one of the rows, and that row."""
    least = np.full(len(others), np.inf)
    nearest = np.full(len(others), rows[0])
    for part in np.array_split(rows, max(1, len(rows) * len(others) // _CHUNK)):
        gap = np.linalg.norm(points[part, None] - points[others], axis=2) - radius[part, None]
        best = gap.argmin(axis=0)
        found = gap[best, np.arange(len(others))]
        nearer = found < least
        least[nearer], nearest[nearer] = found[nearer], part[best[nearer]]
    return least - radius[others], nearest


def _join(net: Net, a: int, b: int, apart: float, radius: Floats) -> bool:
    """Add a branch between two points, or let one take over a single point in its ball; return whether one is new."""
    for single, other, room in ((a, b, radius[1]), (b, a, radius[0])):
        if net.at.get(single) == [] and apart < room:
            net.absorb(single, other)
            return False
    net.connect(a, b)
    return True
