# SPDX-License-Identifier: GPL-3.0-or-later
"""Folded and dented polygons of an axis, seen along the line between their two samples.

A Voronoi facet is convex and turns counter-clockwise about that line. A facet at the rim of a round hole has a concave
corner once its vertices are on the rim, so a concave corner is a dent and not yet a fold. A facet that was pulled onto
a seam or a crease is a line: it covers nothing, and has no turn.
"""

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.integer]
Marks = NDArray[np.bool_]

TURN = 1e-9  # the sine of a turn that is straight but for rounding
PLACE = 1e-14  # of the size of the axis: what rounding moves a corner


class Rings:
    """Polygons in the planes across their directions, (n, k, 2) for each number k of corners."""

    def __init__(self, vertices: Array, offsets: Ints, corners: Ints, across: Array) -> None:
        self._vertices, self._offsets = vertices, offsets
        self._corners, self._across = corners, across
        size = np.linalg.norm(np.ptp(vertices, axis=0)) if len(vertices) else 0.0
        self._room = PLACE * float(size)

    def folded(self) -> Marks:
        """(f,) polygons that are turned over, run back along themselves or cross themselves."""
        return self._marked(self._is_folded)

    def dented(self) -> Marks:
        """(f,) polygons with a concave corner that are neither folded nor lines."""
        return self._marked(self._is_dented)

    def lines(self) -> Marks:
        """(f,) polygons all of whose corners are on one line, or at one point."""
        return self._marked(self._is_line)

    def _marked(self, test: Callable[[Array], Marks]) -> Marks:
        found = np.zeros(len(self._across), bool)
        for rows, at in self._flat():
            found[rows] = test(at)
        return found

    def _flat(self) -> Iterator[tuple[Ints, Array]]:
        counts = np.diff(self._offsets)
        for k in np.unique(counts):
            rows = np.flatnonzero(counts == k)
            ring = self._corners[self._offsets[rows][:, None] + np.arange(k)]
            places = self._vertices[ring]
            right, up = _frame(self._across[rows])
            places = places - places[:, :1]
            yield (
                rows,
                np.stack([np.einsum("nki,ni->nk", places, axis) for axis in (right, up)], axis=2),
            )

    def _is_folded(self, at: Array) -> Marks:
        found = self._turned_over(at) | self._back(at) | self._crossed(at)
        return found & ~self._is_line(at)

    def _is_dented(self, at: Array) -> Marks:
        right = self._turns_right(at).any(axis=1)
        return right & ~self._is_folded(at) & ~self._is_line(at)

    def _is_line(self, at: Array) -> Marks:
        rows = np.arange(len(at))
        chord = at[rows, np.argmax(_length(at), axis=1)]  # the first corner is the origin
        length = np.maximum(_length(chord), np.finfo(float).tiny)
        heights = np.abs(_cross(chord[:, None], at)).max(axis=1) / length
        return heights <= TURN * length + self._room

    def _turned_over(self, at: Array) -> Marks:
        a, b = at[:, 1:-1], at[:, 2:]
        lengths = _length(a) * _length(b)
        room = TURN * 1e-3 * lengths + self._room * (_length(a) + _length(b))
        return _cross(a, b).sum(axis=1) < -room.sum(axis=1)

    def _turns_right(self, at: Array) -> Marks:
        into, out = _sides(at)
        return _cross(into, out) < -self._room_of(into, out, TURN)

    def _back(self, at: Array) -> Marks:
        """A side that runs back along the one before it."""
        into, out = _sides(at)
        room = self._room_of(into, out, TURN)
        along = np.einsum("nki,nki->nk", into, out)
        return ((along < -room) & (_cross(into, out) <= room)).any(axis=1)

    def _crossed(self, at: Array) -> Marks:
        """Two sides that are no neighbours cross inside both."""
        k, found = at.shape[1], np.zeros(len(at), bool)
        for i in range(k - 2):
            for j in range(i + 2, k - (i == 0)):
                a, b, c, d = at[:, i], at[:, i + 1], at[:, j], at[:, (j + 1) % k]
                parted = self._side(a, b, c) * self._side(a, b, d) < 0
                found |= parted & (self._side(c, d, a) * self._side(c, d, b) < 0)
        return found

    def _side(self, a: Array, b: Array, c: Array) -> Array:
        """(n,) 1 left of the line through two points, -1 right of it, 0 within rounding."""
        along, away = b - a, c - a
        area = _cross(along, away)
        return np.sign(area) * (np.abs(area) > self._room_of(along, away, TURN * 1e-3))

    def _room_of(self, a: Array, b: Array, sine: float) -> Array:
        return sine * _length(a) * _length(b) + self._room * (_length(a) + _length(b))


def _frame(across: Array) -> tuple[Array, Array]:
    """(n, 3) twice: unit vectors across each direction, so that right, up and the direction are right-handed."""
    least = np.eye(3)[np.argmin(np.abs(across), axis=1)]
    right = np.cross(least, across)
    right /= np.linalg.norm(right, axis=1)[:, None]
    return right, np.cross(across, right)


def _sides(at: Array) -> tuple[Array, Array]:
    """(n, k, 2) twice: each side, and the one after it."""
    along = np.roll(at, -1, axis=1) - at
    return along, np.roll(along, -1, axis=1)


def _cross(a: Array, b: Array) -> Array:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _length(a: Array) -> Array:
    return np.linalg.norm(a, axis=-1)
