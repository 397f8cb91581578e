# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a medial axis: its pieces, and the axis without small ones.

This is for axes as published, which consist of facets only.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Longs
from ..small_matrices import dot
from ..united import united
from .medial_axis import OUTER, MedialAxis

_PER_FACET = ("theta", "rho", "side", "generators")


def pieces(axis: MedialAxis) -> Longs:
    """Return the number of the connected piece of each facet, (f,); piece 0 has the most facets."""
    if not axis.facets:
        return np.zeros(0, np.int64)
    first = axis.face_vertices[axis.face_offsets[:-1]]
    pairs = np.column_stack((np.repeat(first, np.diff(axis.face_offsets)), axis.face_vertices))
    label = united(len(axis.vertices), pairs)[first]
    _, piece, counts = np.unique(label, return_inverse=True, return_counts=True)
    order = np.argsort(-counts, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return rank[piece.ravel()]


def without_small_pieces(axis: MedialAxis, share: float) -> MedialAxis:
    """Keep the pieces that have at least this share of the facets; the largest always stays."""
    if share <= 0.0 or not axis.facets:
        return axis
    piece = pieces(axis)
    counts = np.bincount(piece)
    return _with_pieces(axis, piece, counts >= share * axis.facets)


def without_shards(axis: MedialAxis, diameters: float) -> MedialAxis:
    """Drop the outer pieces that are smaller than this many diameters of their balls; the largest piece always stays.

    The diagonal of the bounding box of a piece counts, and the mean of the balls at its corners. Sheets of the outside
    reach many diameters far; a piece that does not is a remainder of one that the thresholds have not kept.
    """
    if diameters <= 0.0 or not (axis.side == OUTER).any():
        return axis
    piece = pieces(axis)
    of_corner = np.repeat(piece, np.diff(axis.face_offsets))
    places, count = axis.vertices[axis.face_vertices], int(piece.max()) + 1
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, of_corner, places)
    np.maximum.at(high, of_corner, places)
    corners = np.bincount(of_corner, minlength=count)
    mean = np.bincount(of_corner, axis.radius[axis.face_vertices], count) / corners
    with np.errstate(divide="ignore", invalid="ignore"):
        box = (high - low) / mean[:, None]
    across = np.sqrt(dot(box, box))
    outer = np.bincount(piece, axis.side != OUTER, count) == 0
    small = across < 2.0 * diameters  # what is no number stays
    return _with_pieces(axis, piece, ~(outer & small))


def _with_pieces(axis: MedialAxis, piece: NDArray[np.intp], large: Flags) -> MedialAxis:
    """Keep the large pieces, and always the largest, which is the first."""
    large[0] = True
    return axis if large.all() else with_facets(axis, large[piece])


def with_facets(axis: MedialAxis, keep: Flags) -> MedialAxis:
    """Keep the facets that (f,) bool marks, and their vertices, in the same order."""
    sizes = np.diff(axis.face_offsets)
    corners = axis.face_vertices[np.repeat(keep, sizes)]
    used = np.zeros(len(axis.vertices), np.bool_)
    used[corners] = True
    row = np.cumsum(used) - 1
    offsets = np.concatenate([[0], np.cumsum(sizes[keep])])
    return replace(
        axis,
        vertices=axis.vertices[used],
        radius=axis.radius[used],
        face_offsets=offsets.astype(np.int32),
        face_vertices=row[corners].astype(np.int32),
        **{name: getattr(axis, name)[keep] for name in _PER_FACET},
    )
