# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies all of whose faces stand twice, as exports with both sides of each face have them.

In one body two equal faces may be a wall between two rooms, of which none bounds the solid. Where every face of a
connected part stands an even number of times, nothing would be left of it: there the first of each is meant.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints
from ..machine import native

# Odd numbers of 64 bits without a pattern, as splitmix64 has them.
_FACTORS = np.array(
    [0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB, 0xD6E8FEB86659FD93], np.uint64
)


def repeats_of_bodies(points: Floats, triangles: Ints) -> Flags:
    """(m,) mark the faces that repeat an earlier one, in any direction, of parts in which every face is repeated."""
    keys = _keys(points, triangles)
    _, first, of_key, count = np.unique(
        keys, return_index=True, return_inverse=True, return_counts=True
    )
    repeated = np.zeros(len(triangles), bool)
    if len(first) == len(triangles):
        return repeated
    repeated[:] = True
    repeated[first] = False
    with native.own_errors() as module:
        part, _, _ = module.mesh_parts(points, triangles)
    known = part >= 0
    alone = np.zeros(int(part.max(initial=-1)) + 2, bool)  # the last one is of no part, -1
    alone[part[known & (count[of_key] % 2 == 1)]] = True
    return repeated & known & ~alone[part]


def _keys(points: Floats, triangles: Ints) -> NDArray[np.uint64]:
    """Return a number for the corners of each face, (m,), in any order; equal coordinates are one corner."""
    bits = np.ascontiguousarray(points + 0.0).view(np.uint64)  # -0.0 is 0.0
    corner = np.zeros(len(points), np.uint64)
    for axis in range(3):
        corner = (corner ^ bits[:, axis]) * _FACTORS[axis]
        corner ^= corner >> np.uint64(29)
    corner *= _FACTORS[3]
    corner ^= corner >> np.uint64(32)
    return np.asarray(corner[triangles].sum(axis=1, dtype=np.uint64))
