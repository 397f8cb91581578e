# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces cut until none of their edges is long, along the same places on both sides of every edge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints, Longs
from ..shape.triangles import edges_of, side_keys, sides_of
from ..small_matrices import dot

_Columns = NDArray[Any]  # (3, n), turned until the edge that differs from the others comes first
# Which of the triangles have such a piece, its corners, and the kinds of its edges.
_Part = tuple[Flags, tuple[NDArray[Any], ...], tuple[NDArray[Any], ...]]


@dataclass(frozen=True, eq=False)
class FineFaces:
    """Triangles that are pieces of faces."""

    points: Floats  # (n, 3) The vertices of the faces, then the middles of edges
    triangles: Ints  # (f, 3)
    faces: Ints  # (f,) The face in which each triangle lies
    # (f, 3) Of the edge from each corner to the next: 0, or what the edge of the faces had of which it is a part
    kinds: NDArray[np.int8]

    def edges(self) -> Ints:
        """(e, 2) the ends of all edges."""
        return edges_of(self.triangles)


def coarse_faces(
    points: Floats, triangles: Ints, edges: Ints, of_edges: NDArray[np.int8]
) -> FineFaces:
    """The faces themselves.

    Parameters
    ----------
    points : (v, 3) float64
    triangles : (m, 3) int32
        Faces that meet have the same rows there.
    edges : (e, 2) int32
        Some edges, and
    of_edges : (e,) int8
        what their parts have as `kinds`.
    """
    count = len(points)
    low, high = edges.min(axis=1).astype(np.int64), edges.max(axis=1)
    known = low * count + high
    order = np.argsort(known)
    keys = side_keys(triangles, count)
    kinds = np.zeros(keys.shape, np.int8)
    if len(order):
        at = np.minimum(np.searchsorted(known[order], keys), len(order) - 1)
        kinds = np.where(known[order][at] == keys, of_edges[order][at], kinds)
    return FineFaces(points, triangles, np.arange(len(triangles), dtype=np.int32), kinds)


def cut_faces(found: FineFaces, longest: float, some: Flags | None = None) -> FineFaces:
    """Halve edges that are longer than a length until there are none, or only around (m,) some of the faces."""
    while (cut := _halved(found, longest, some)) is not None:
        found = cut
    return found


def _halved(found: FineFaces, longest: float, some: Flags | None) -> FineFaces | None:
    points, triangles = found.points, found.triangles
    ways = points[np.roll(triangles, -1, axis=1)] - points[triangles]
    lengths = np.sqrt(dot(ways, ways))
    too_long = lengths > longest
    if some is not None:
        too_long &= some[found.faces][:, None]
    if not too_long.any():
        return None
    edges, of_sides, _ = sides_of(triangles)
    long = np.zeros(len(edges), bool)
    long[of_sides[too_long]] = True
    number = np.where(long, len(points) + np.cumsum(long) - 1, -1)
    ends = edges[long].T
    middles = (points[ends[0]] + points[ends[1]]) / 2.0
    pieces = _pieces(triangles, found.kinds, number[of_sides], lengths)
    rows = np.concatenate([row for row, _, _ in pieces])
    order = np.argsort(rows, kind="stable")
    return FineFaces(
        np.concatenate((points, middles)),
        np.concatenate([corners for _, corners, _ in pieces])[order].astype(np.int32),
        found.faces[rows[order]],
        np.concatenate([kinds for _, _, kinds in pieces])[order].astype(np.int8),
    )


def _pieces(
    triangles: Ints, kinds: NDArray[np.int8], middles: Longs, lengths: Floats
) -> list[tuple[NDArray[np.intp], Longs, NDArray[np.int8]]]:
    """The pieces of triangles, grouped by how they were cut: the rows, the corners, and the kinds of their edges.

    Parameters
    ----------
    triangles : (f, 3) int32
    kinds : (f, 3) int8
    middles : (f, 3) int64
        The point in the middle of the edge from each corner to the next; -1 where the edge stays whole.
    lengths : (f, 3) float64
        Of these edges.
    """
    cuts = (middles >= 0).sum(axis=1)
    whole = np.flatnonzero(cuts == 0)
    pieces = [(whole, triangles[whole].astype(np.int64), kinds[whole])]
    for count in (1, 2, 3):
        rows = np.flatnonzero(cuts == count)
        first = (middles[rows] >= 0).argmax(axis=1)  # the edge that is cut alone
        if count == 2:  # the edge that stays whole
            first = (middles[rows] < 0).argmax(axis=1)
        turn = (first[:, None] + np.arange(3)) % 3
        row = rows[:, None]
        corners, kind = triangles[row, turn].T.astype(np.int64), kinds[row, turn].T
        middle, length = middles[row, turn].T, lengths[row, turn].T
        parts = (_halves, _thirds, _quarters)[count - 1](corners, kind, middle, length)
        pieces += [
            (rows[some], np.stack(part, axis=1)[some], np.stack(edges, axis=1)[some])
            for some, part, edges in parts
        ]
    return pieces


def _halves(
    corners: _Columns, kinds: _Columns, middles: _Columns, _lengths: _Columns
) -> list[_Part]:
    (a, b, c), (ab, bc, ca), m, inner = corners, kinds, middles[0], np.zeros_like(kinds[0])
    every = np.ones(len(a), bool)
    return [(every, (a, m, c), (ab, inner, ca)), (every, (m, b, c), (ab, bc, inner))]


def _thirds(
    corners: _Columns, kinds: _Columns, middles: _Columns, lengths: _Columns
) -> list[_Part]:
    (a, b, c), (ab, bc, ca), inner = corners, kinds, np.zeros_like(kinds[0])
    m, n = middles[1], middles[2]  # of bc and ca
    every, to_m = np.ones(len(a), bool), lengths[1] >= lengths[2]
    return [
        (every, (n, m, c), (inner, bc, ca)),
        (to_m, (a, b, m), (ab, bc, inner)),
        (to_m, (a, m, n), (inner, inner, ca)),
        (~to_m, (a, b, n), (ab, inner, ca)),
        (~to_m, (b, m, n), (bc, inner, inner)),
    ]


def _quarters(
    corners: _Columns, kinds: _Columns, middles: _Columns, _lengths: _Columns
) -> list[_Part]:
    (a, b, c), (ab, bc, ca), (m, n, k) = corners, kinds, middles
    every, inner = np.ones(len(a), bool), np.zeros_like(ab)
    return [
        (every, (a, m, k), (ab, inner, ca)),
        (every, (m, b, n), (ab, bc, inner)),
        (every, (k, n, c), (inner, bc, ca)),
        (every, (m, n, k), (inner, inner, inner)),
    ]
