# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets of even triangles: their borders divided to a size, and each sheet remeshed between its borders."""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..shape.triangles import sides_of

_LONGEST = 4.0 / 3.0  # lengths: the remeshing moves no longer edge; derived: kLong


def even_triangles(
    points: Floats, triangles: Ints, part: Ints, length: float, progress: Progress | None = None
) -> tuple[Floats, Ints, Ints]:
    """Remesh sheets to triangles that are nearly equilateral; sheets that share edges still do.

    A sheet that touches itself, so that an edge has three triangles of it, has divided triangles instead.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (t, 3) int32
        Neighbours of the same sheet turn the same way.
    part : (t,) int32
        The sheet of each triangle.
    length : float
        Of the edges that are wanted; none is longer than about 4/3 of it.
    progress : Progress, optional

    Returns
    -------
    points : (m, 3) float64
    triangles : (s, 3) int32
    part : (s,) int32
        Ascending.
    """
    points, triangles, of = divided(points, triangles, _LONGEST * length)
    part = part[of]
    places, rows, parts = [points], [], []
    count = len(points)
    for sheet in np.unique(part):
        used, corners = np.unique(triangles[part == sheet], return_inverse=True)
        corners = corners.reshape(-1, 3).astype(np.int32)
        with own_errors() as module:
            found = module.even_sheet(points[used], corners, length, progress=progress)
        row = used
        if found is not None:
            made, given, corners = found
            new = given < 0
            row = np.where(new, count + np.cumsum(new) - 1, used[given])
            places.append(made[new])
            count += int(new.sum())
        rows.append(row[corners])
        parts.append(np.full(len(corners), sheet, np.int32))
    kept, triangles = np.unique(np.concatenate(rows), return_inverse=True)
    return (
        np.concatenate(places)[kept],
        triangles.reshape(-1, 3).astype(np.int32),
        np.concatenate(parts),
    )


def divided(points: Floats, triangles: Ints, longest: float) -> tuple[Floats, Ints, Longs]:
    """Divide triangles by the bisection of Rivara: no angle is less than half of the least one before.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (t, 3) int32
    longest : float

    Returns
    -------
    points : (m, 3) float64
        The given points, then the middles of edges.
    triangles : (s, 3) int32
        Each turns as the one of which it is a piece.
    of : (s,) int64
        The triangle of which each is a piece.
    """
    of = np.arange(len(triangles))
    while True:
        corners = points[triangles]
        lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        edges, edge, _ = sides_of(triangles)
        cut = _cut_edges(edge, lengths, longest, len(edges))
        if not cut.any():
            return points, triangles, of
        middle = np.full(len(edges), -1, np.int64)
        middle[cut] = len(points) + np.arange(cut.sum())
        points = np.concatenate((points, points[edges[cut]].mean(axis=1)))
        # Each round halves the longest edge of a triangle only, so that all pieces are those of Rivara.
        triangles, rows = _halved(triangles, edge, lengths, middle)
        of = of[rows]


def _cut_edges(edge: Longs, lengths: Floats, longest: float, count: int) -> Flags:
    """(e,) the edges that are too long, and the longest edges of all triangles that have a cut edge."""
    cut = np.zeros(count, bool)
    cut[edge[lengths > longest]] = True
    first = edge[np.arange(len(edge)), _longest(lengths, edge)]
    while True:
        more = first[cut[edge].any(axis=1)]
        if cut[more].all():
            return cut
        cut[more] = True


def _longest(lengths: Floats, edge: Longs) -> Longs:
    """(t,) the longest side of each triangle; of equal ones that with the lowest number, in all triangles the same."""
    most = lengths.max(axis=1, keepdims=True)
    numbers = np.where(lengths >= most, edge, np.iinfo(np.int64).max)
    return np.asarray(numbers.argmin(axis=1))


def _halved(triangles: Ints, edge: Longs, lengths: Floats, middle: Longs) -> tuple[Ints, Longs]:
    """The pieces of the triangles, halved at the longest edge, and each half at its cut edge; and their rows."""
    side = _longest(lengths, edge)
    rows = np.arange(len(triangles))
    a, b, c = (triangles[rows, (side + k) % 3] for k in range(3))
    ab, bc, ca = (middle[edge[rows, (side + k) % 3]] for k in range(3))
    pieces, of = [], []

    def add(which: Flags, *corners: Longs) -> None:
        pieces.append(np.column_stack(corners)[which])
        of.append(rows[which])

    whole = ab < 0
    add(whole, a, b, c)
    add(~whole & (bc < 0), ab, b, c)
    add(~whole & (bc >= 0), ab, b, bc)
    add(~whole & (bc >= 0), ab, bc, c)
    add(~whole & (ca < 0), a, ab, c)
    add(~whole & (ca >= 0), a, ab, ca)
    add(~whole & (ca >= 0), ca, ab, c)
    order = np.argsort(np.concatenate(of), kind="stable")
    return np.concatenate(pieces)[order].astype(np.int32), np.concatenate(of)[order]
