# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of triangles as quadrilaterals: nearly all triangles of a sheet have a partner."""

from __future__ import annotations

from collections import deque

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..shape.triangles import sides_of, unit_normals
from ..small_matrices import dot

LEAST_SINE = 0.5  # at the corners: angles of 30 to 150 degrees; chosen: midsurface
_FLAT = 0.9  # the cosine between the two triangles, at least; chosen: unseen


def paired(points: Floats, triangles: Ints, part: Ints) -> tuple[Longs, Ints]:
    """(k, 4) quadrilaterals and, with -1 as their fourth corner, triangles; and (k,) their sheet.

    Each keeps the turn of its triangles. The same triangles give the same pairs.
    """
    pairs, quads, value = _candidates(points, triangles, part)
    partner = _matched(len(triangles), pairs, value)
    chosen = partner[pairs[:, 0]] == pairs[:, 1]
    alone = partner < 0
    single = np.column_stack((triangles[alone], np.full(alone.sum(), -1)))
    of = np.concatenate((part[pairs[chosen, 0]], part[alone]))
    return np.concatenate((quads[chosen], single)).astype(np.int64), of


def least_sines(corners: Floats) -> Floats:
    """(q,) the least sine of an angle of each of (q, 4, 3) quadrilaterals; not above 0 where one is dented."""
    ahead = np.roll(corners, -1, axis=1) - corners
    ahead /= np.maximum(np.linalg.norm(ahead, axis=2), np.finfo(float).tiny)[:, :, None]
    turns = np.cross(np.roll(ahead, 1, axis=1), ahead)
    whole = turns.sum(axis=1)
    whole /= np.maximum(np.linalg.norm(whole, axis=1), np.finfo(float).tiny)[:, None]
    return np.asarray(dot(turns, whole[:, None]).min(axis=1))


def _candidates(points: Floats, triangles: Ints, part: Ints) -> tuple[Longs, Longs, Floats]:
    """(k, 2) pairs of triangles of one sheet that share an edge, (k, 4) what they are together, (k,) how good that is.

    Those that make a bad quadrilateral are left out.
    """
    _, edge, uses = sides_of(triangles)
    edge = edge.ravel()
    sides = np.flatnonzero(uses[edge] == 2)
    sides = sides[np.argsort(edge[sides], kind="stable")].reshape(-1, 2)
    (a, b), (i, j) = (sides // 3).T, (sides % 3).T
    quads = np.column_stack(
        (
            triangles[a, i],
            triangles[b, (j + 2) % 3],
            triangles[a, (i + 1) % 3],
            triangles[a, (i + 2) % 3],
        )
    )
    normals, _ = unit_normals(points[triangles])
    value = least_sines(points[quads])
    good = (part[a] == part[b]) & (triangles[a, i] == triangles[b, (j + 1) % 3])
    good &= (value >= LEAST_SINE) & (dot(normals[a], normals[b]) >= _FLAT)
    return np.column_stack((a, b))[good].astype(np.int64), quads[good], value[good]


def _matched(count: int, pairs: Longs, value: Floats) -> Longs:
    """(count,) the partner of each triangle, -1 where it has none: the best pairs first, then exchanges for more."""
    partner = np.full(count, -1)
    beside: list[list[int]] = [[] for _ in range(count)]
    for row in np.argsort(-value, kind="stable").tolist():
        a, b = pairs[row].tolist()
        beside[a].append(b)
        beside[b].append(a)
        if partner[a] < 0 and partner[b] < 0:
            partner[a], partner[b] = b, a
    found = partner.tolist()
    for start in np.flatnonzero(partner < 0).tolist():
        if found[start] < 0:
            _exchange(start, beside, found)
    return np.array(found)


def _exchange(start: int, beside: list[list[int]], partner: list[int]) -> None:
    """Give a triangle a partner by a way over pairs, whose triangles change partners, to another single triangle."""
    came = {
        start: (-1, -1)
    }  # the outer end of each pair on the way, and the pair's other triangle and the end before
    waiting = deque([start])
    seen = {start}
    while waiting:
        outer = waiting.popleft()
        for near in beside[outer]:
            if near in seen:
                continue
            seen.add(near)
            if partner[near] < 0:
                _change(near, outer, came, partner)
                return
            far = partner[near]
            if far not in seen:
                seen.add(far)
                came[far] = (near, outer)
                waiting.append(far)


def _change(last: int, outer: int, came: dict[int, tuple[int, int]], partner: list[int]) -> None:
    while last >= 0:
        partner[last], partner[outer] = outer, last
        last, outer = came[outer]
