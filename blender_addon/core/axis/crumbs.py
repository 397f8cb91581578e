# SPDX-License-Identifier: GPL-3.0-or-later
"""Crumbs: pieces of a level without a facet that are hardly larger than the spacing of the samples.

Where faces bound nothing, or walls are closer than the samples, scattered samples enclose small bodies that the shape
does not have. Their axes are single points and short wires.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints, Longs
from ..samples.analysed import Analysed
from ..shape.nearness import nearest
from ..united import united
from .medial_axis import MedialAxis
from .rows_of_axis import with_rows

LARGEST = 4.0  # larger pieces are no crumbs, whatever the setting; chosen: unseen


def crumb_sizes(level: Any, samples: Analysed) -> NDArray[np.float32]:
    """(v,) the size of the piece of each vertex, in spacings of the samples there; infinite where it is no crumb.

    The size of a piece is its largest radius and half the diagonal of the box round its vertices. Nothing is a crumb
    where the closed faces have as many pieces as the level.
    """
    found = np.full(len(level.vertices), np.inf, np.float32)
    if samples.by_faces is not None and samples.by_faces[0] == level.betti[0]:
        return found
    spacing = samples.neighbours
    small = level.radius < LARGEST * spacing.max(initial=0.0)
    small[level.face_vertices] = False
    piece = _piece_of(level.wires, small)
    rows = np.flatnonzero(piece >= 0)
    if len(rows):
        size, middle = _sizes(level, rows, piece[rows])
        size /= spacing[nearest(level.vertices[middle], samples.points)]
        found[rows] = np.where(size < LARGEST, size, np.inf)
    return found


def crumbs_below(axis: MedialAxis, smallest: float) -> int:
    """Return how many pieces `without_crumbs` leaves out."""
    crumb = None if axis.level is None else axis.level.crumb
    if crumb is None:
        return 0
    small = crumb < smallest
    piece = _piece_of(axis.edges, small)
    return len(np.unique(piece[small]))


def without_crumbs(axis: MedialAxis, smallest: float) -> MedialAxis:
    """Leave out the pieces that are smaller than `smallest` spacings; one piece always stays."""
    level = axis.level
    if level is None or level.crumb is None or smallest <= 0.0:
        return axis
    keep = level.crumb >= smallest
    if keep.all() or not keep.any():
        return axis
    wires = keep[axis.edges[:, 0]] if len(axis.edges) else np.zeros(0, bool)
    return with_rows(axis, keep, axis.edges[wires], level.limb[wires])


def _piece_of(wires: Ints, small: Flags) -> Longs:
    """Return the lowest vertex of the piece of each vertex, (v,); -1 where a vertex of the piece is not small."""
    both = wires[small[wires].all(axis=1)]
    piece = united(len(small), both)
    mixed = wires[small[wires].any(axis=1) & ~small[wires].all(axis=1)].ravel()
    large = np.zeros(len(small), np.bool_)
    large[piece[mixed]] = True
    return np.where(small & ~large[piece], piece, -1)


def _sizes(level: Any, rows: Longs, piece: Longs) -> tuple[Floats, Longs]:
    """Return the size of the piece of each of these vertices, (r,), and the first vertex of that piece."""
    order = np.argsort(piece, kind="stable")
    starts = np.flatnonzero(np.diff(piece[order], prepend=-1))
    places, radius = level.vertices[rows][order], level.radius[rows][order]
    box = np.maximum.reduceat(places, starts) - np.minimum.reduceat(places, starts)
    sizes = np.maximum.reduceat(radius, starts) + 0.5 * np.linalg.norm(box, axis=1)
    number = np.empty(len(rows), np.int64)
    number[order] = np.repeat(np.arange(len(starts)), np.diff([*starts, len(rows)]))
    return sizes[number], rows[order[starts]][number]
