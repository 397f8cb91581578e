# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges at which sheets end, one after the other, and the stretches of them that end at one wall."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..small_matrices import dot


@dataclass(frozen=True, eq=False)
class Chain:
    """Edges of one sheet, each of which begins where the one before it ends."""

    rows: Longs  # (k,)
    closed: bool  # The first follows the last


def chains_of(ends: Longs, part: Ints) -> list[Chain]:
    """Return the chains of directed edges, (k, 2) rows of vertices, within each sheet.

    Chains end where not exactly one edge of the sheet comes and one goes.
    """
    count = int(ends.max(initial=-1)) + 1
    keys = part.astype(np.int64)[:, None] * count + ends
    _, number = np.unique(keys, return_inverse=True)
    number = number.reshape(keys.shape)
    goes, comes = (np.bincount(each, minlength=number.max(initial=-1) + 1) for each in number.T)
    at = np.full(len(goes), -1, np.int64)
    at[number[:, 0]] = np.arange(len(ends))
    passes = (goes == 1) & (comes == 1)
    after = np.where(passes[number[:, 1]], at[number[:, 1]], -1)
    first = np.flatnonzero(~passes[number[:, 0]])
    seen = np.zeros(len(ends), bool)
    found = [Chain(_followed(row, after, seen), closed=False) for row in first]
    for row in range(len(ends)):
        if not seen[row]:
            found.append(Chain(_followed(row, after, seen), closed=True))
    return found


def _followed(row: int, after: Longs, seen: Flags) -> Longs:
    rows = []
    while row >= 0 and not seen[row]:
        seen[row] = True
        rows.append(row)
        row = int(after[row])
    return np.array(rows, np.int64)


def runs_of(apart: Flags) -> Iterator[Longs]:
    """Yield the places in a chain of each stretch, given (k,) whether an edge is apart from the one before it."""
    begins = np.flatnonzero(apart)
    first = begins[0] if len(begins) else 0
    places = np.roll(np.arange(len(apart)), -first)
    if len(places):
        yield from np.split(places, begins[1:] - first)


def nearest_along(lengths: Floats, sites: Longs, closed: bool) -> Longs:
    """(k,) the site that is nearest along a chain to each edge, given their (k,) lengths; sites ascend."""
    middles = np.cumsum(lengths) - 0.5 * lengths
    along = middles[sites]
    if closed:
        whole = lengths.sum()
        along = np.concatenate((along - whole, along, along + whole))
        sites = np.tile(sites, 3)
    after = np.minimum(np.searchsorted(along, middles), len(along) - 1)
    before = np.maximum(after - 1, 0)
    is_after = np.abs(along[after] - middles) < np.abs(along[before] - middles)
    return np.asarray(sites[np.where(is_after, after, before)])


def without_ways_back(places: Floats, ways: Floats) -> Floats:
    """(k + 1, 3) places along a stretch of which none lies behind one before it, given the (k, 3) ways of its edges.

    The first and the last stay. A place that is behind waits where the stretch has come to.
    """
    if not (dot(places[1:] - places[:-1], ways) < 0.0).any():
        return places
    found = places.copy()
    for edge in range(len(ways) - 1):
        if dot(found[edge + 1] - found[edge], ways[edge]) < 0.0:
            found[edge + 1] = found[edge]
    for edge in range(len(ways) - 1, 0, -1):
        if dot(found[edge + 1] - found[edge], ways[edge]) < 0.0:
            found[edge] = found[edge + 1]
    return found
