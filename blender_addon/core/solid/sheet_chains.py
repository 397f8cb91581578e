# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges at which sheets end, one after the other, and the stretches of them that end at one wall."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..small_matrices import dot

if TYPE_CHECKING:
    from numpy.typing import NDArray

_STRAIGHT = 1e-6  # of its length: a stretch that departs less from its chord is straight


@dataclass(frozen=True, eq=False)
class Chain:
    """Edges of one sheet, each of which begins where the one before it ends.

    Parameters
    ----------
    rows : (k,) int64
    closed : bool
        The first follows the last.
    """

    rows: NDArray[np.int64]
    closed: bool


def chains_of(ends: NDArray[np.int64], part: NDArray[np.int32]) -> list[Chain]:
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


def _followed(row: int, after: NDArray[np.int64], seen: NDArray[np.bool_]) -> NDArray[np.int64]:
    rows = []
    while row >= 0 and not seen[row]:
        seen[row] = True
        rows.append(row)
        row = int(after[row])
    return np.array(rows, np.int64)


def runs_of(apart: NDArray[np.bool_]) -> Iterator[NDArray[np.int64]]:
    """Yield the places in a chain of each stretch, given (k,) whether an edge is apart from the one before it."""
    begins = np.flatnonzero(apart)
    first = begins[0] if len(begins) else 0
    places = np.roll(np.arange(len(apart)), -first)
    if len(places):
        yield from np.split(places, begins[1:] - first)


def nearest_along(
    lengths: NDArray[np.float64], sites: NDArray[np.int64], closed: bool
) -> NDArray[np.int64]:
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


def without_ways_back(
    vertices: NDArray[np.float64], around: NDArray[np.int64]
) -> NDArray[np.float64]:
    """(k, 3) the places of vertices along a stretch, of which those of a straight one never go back."""
    places = vertices[around]
    way = places[-1] - places[0]
    length = float(np.sqrt(dot(way, way)))
    if length <= 0.0:
        return places
    way = way / length
    along = dot(places - places[0], way)
    off = places - places[0] - along[:, None] * way
    if np.abs(off).max() > _STRAIGHT * length:
        return places
    along = np.clip(np.maximum.accumulate(along), 0.0, length)
    found = places[0] + along[:, None] * way
    found[along == length] = places[-1]
    return found
