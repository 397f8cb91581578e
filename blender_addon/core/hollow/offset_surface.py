# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface inside a solid at one distance from its faces.

It is where the distance to the faces, which is exact, crosses the edges of a lattice of tetrahedra (marching
tetrahedra on a body-centred cubic lattice). Each triangle lies in its own tetrahedron, so no two cross, and each edge
has two triangles. Only tetrahedra near the surface are looked at: the distance changes by no more than the way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints, Longs
from ..small_matrices import dot
from ..united import united

Field = Callable[[Floats], Floats]

COARSEST = 0.5  # of the distance, at most; derived: no tetrahedron reaches from wall to surface
_APART = 1e-3  # vertices keep this share of their edge to its ends, so that no two coincide; derived: rounding
_CLOSE = 1e-7  # of the distance: so near to it a vertex is at it; derived: a float's rounding
_ROUNDS = 40  # each halves an edge at least every second time
_SHIFT = (
    0.381966,
    0.270141,
    0.445042,
)  # steps: planes of the lattice shall not be those of the model
_CORNERS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
_BESIDE = 2 * np.concatenate((np.identity(3, int), -np.identity(3, int)))


@dataclass(frozen=True, eq=False)
class OffsetSurface:
    """A closed surface without self-crossings."""

    vertices: Floats  # (v, 3)
    triangles: Ints  # (t, 3) Counter-clockwise as seen from the faces of the solid
    distances: Floats  # (v,) How far each vertex is from the faces


def offset_surface(
    low: Floats, high: Floats, length: float, step: float, field: Field, winding: Field
) -> OffsetSurface:
    """Find the surface at a distance from faces.

    Parameters
    ----------
    low, high : (3,) float64
        Corners of a box that holds the solid.
    length : float
        The distance.
    step : float
        The edge of the cubes of the lattice; at most `COARSEST` times the distance.
    field : callable
        Maps (q, 3) places to their (q,) distances from the faces.
    winding : callable
        Maps (q, 3) places to their (q,) winding numbers.
    """
    origin = low - step * np.array(_SHIFT)
    half = 0.5 * step  # nodes have whole coordinates: corners of cubes even ones, centres odd ones

    def at(nodes: NDArray[Any]) -> Floats:
        return field(origin + half * nodes)

    count = int(np.ceil((high - origin).max() / step)) + 1
    cells = _cells_at(length / half, count, lambda nodes: at(nodes) / half)
    cells = _inside(cells, lambda nodes: winding(origin + half * nodes))
    nodes, tetrahedra = _tetrahedra(cells)
    far = at(nodes) - length
    triangles, ends = _marched(nodes, far >= 0.0, tetrahedra)
    vertices, distances = _crossings(origin + half * nodes, far, ends, length, field)
    return OffsetSurface(vertices, triangles, distances)


def _cells_at(length: float, count: int, field: Field) -> Longs:
    """(c, 3) the centres of the cubes through which the surface may go; lengths are in half steps.

    Larger cubes are halved as long as the surface may go through them.
    """
    size = 2
    while size < 2 * count:
        size *= 2
    cells = np.full((1, 3), size // 2)
    while True:
        reach = 0.5 * np.sqrt(3.0) * size * (1.0 + 1e-9)
        cells = cells[np.abs(field(cells) - length) <= reach]
        if size == 2:
            return cells
        size //= 2
        cells = (cells[:, None] + (size // 2) * _CORNERS).reshape(-1, 3)


def _inside(cells: Longs, winding: Field) -> Longs:
    """The cubes inside the solid. No two that share a face are on different sides of its faces."""
    if not len(cells):
        return cells
    keys, wide = _keys(cells)
    order = np.argsort(keys)
    pairs = []
    for way in _BESIDE[:3]:
        beside = keys + int(way @ wide)
        at = np.minimum(np.searchsorted(keys[order], beside), len(keys) - 1)
        rows = np.flatnonzero(keys[order][at] == beside)
        pairs.append(np.column_stack((rows, order[at[rows]])))
    label = united(len(cells), np.concatenate(pairs))
    first, piece = np.unique(label, return_inverse=True)
    return cells[(winding(cells[first].astype(np.float64)) > 0.5)[piece.reshape(-1)]]


def _keys(nodes: Longs) -> tuple[Longs, Longs]:
    """(n,) a number for each node, in the order of its coordinates, and (3,) what each coordinate counts."""
    wide = int(nodes.max(initial=0)) + 5  # neighbours are 2 farther on both sides
    weights = np.array((wide * wide, wide, 1))
    return (nodes + 2) @ weights, weights


def _tetrahedra(cells: Longs) -> tuple[Longs, Longs]:
    """(n, 3) nodes and (k, 4) the tetrahedra round cubes: the centres beside a face, and an edge of that face."""
    keys, weights = _keys(cells)
    found = []
    for way in _BESIDE[:3]:
        low = np.unique(np.concatenate((keys, keys - way @ weights)))
        face = _CORNERS[_CORNERS @ way > 0][[0, 1, 3, 2]]  # one corner after the other
        for a, b in zip(face, np.roll(face, -1, axis=0), strict=True):
            found.append(
                np.stack((low, low + way @ weights, low + a @ weights, low + b @ weights), axis=1)
            )
    used, tetrahedra = np.unique(np.concatenate(found), return_inverse=True)
    rest, z = np.divmod(used, weights[1])
    return np.column_stack((*np.divmod(rest, weights[1]), z)) - 2, tetrahedra.reshape(-1, 4)


def _marched(nodes: Longs, far: Flags, tetrahedra: Longs) -> tuple[Ints, Longs]:
    """(t, 3) triangles, and (v, 2) the near and the far end of the edge on which each of their vertices lies."""
    many = far[tetrahedra].sum(axis=1)
    found = []
    for alone in (1, 3):
        some = tetrahedra[many == alone]
        order = np.argsort(far[some] != (alone == 1), axis=1, kind="stable")
        one, *others = np.take_along_axis(some, order, axis=1).T
        found.append(np.stack([np.column_stack((one, other)) for other in others], axis=1))
    some = tetrahedra[many == 2]
    p, q, r, s = np.take_along_axis(some, np.argsort(~far[some], axis=1, kind="stable"), axis=1).T
    a, b, c, d = (np.column_stack(ends) for ends in ((p, r), (p, s), (q, s), (q, r)))
    found += [np.stack((a, b, c), axis=1), np.stack((a, c, d), axis=1)]
    ends = np.concatenate(found).reshape(-1, 2)
    ends = np.where(far[ends[:, :1]], ends[:, ::-1], ends)
    ends, row = np.unique(ends, axis=0, return_inverse=True)
    triangles = row.reshape(-1, 3)
    middles = nodes[ends].sum(axis=1)
    x, y, z = (middles[triangles[:, corner]] for corner in range(3))
    inward = (nodes[ends[:, 1]] - nodes[ends[:, 0]])[triangles].sum(axis=1)
    turned = dot(np.cross(y - x, z - x), inward) > 0
    triangles[turned] = triangles[turned][:, ::-1]
    return triangles.astype(np.int32), ends


def _crossings(
    places: Floats, far: Floats, ends: Longs, length: float, field: Field
) -> tuple[Floats, Floats]:
    """(v, 3) where the distance is reached on edges, and (v,) the distance there: false position and halves."""
    near, way = places[ends[:, 0]], places[ends[:, 1]] - places[ends[:, 0]]
    low, high = np.zeros(len(ends)), np.ones(len(ends))
    under, over = far[ends].T.copy()
    at, off = np.ones(len(ends)), over.copy()
    rows = np.arange(len(ends))
    for number in range(_ROUNDS):
        share = 0.5 if number % 3 == 2 else under[rows] / (under[rows] - over[rows])
        at[rows] = np.clip(low[rows] + share * (high[rows] - low[rows]), _APART, 1.0 - _APART)
        off[rows] = field(near[rows] + at[rows, None] * way[rows]) - length
        below = rows[off[rows] < 0.0]
        above = rows[off[rows] >= 0.0]
        low[below], under[below] = at[below], off[below]
        high[above], over[above] = at[above], off[above]
        wide = high[rows] - low[rows] > _APART * 1e-3
        rows = rows[(np.abs(off[rows]) > _CLOSE * length) & wide]
        if not len(rows):
            break
    return near + at[:, None] * way, length + off
