# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas and directions of facets, and directions of wires."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def facet_vectors(
    vertices: NDArray[np.float64], offsets: NDArray[np.int32], corners: NDArray[np.int32]
) -> NDArray[np.float64]:
    """(f, 3) a vector along the normal of each facet, as long as its area.

    Parameters
    ----------
    vertices : (v, 3) float64
    offsets : (f + 1,) int32
    corners : (c,) int32
        The corners of facet i are `corners[offsets[i] : offsets[i + 1]]`, counter-clockwise about its normal.
    """
    if len(offsets) < 2:
        return np.zeros((0, 3))
    places, starts = vertices[corners], offsets[:-1]
    towards = np.arange(1, len(places) + 1)
    towards[offsets[1:] - 1] = starts
    away = places - np.repeat(places[starts], np.diff(offsets), axis=0)
    return 0.5 * np.add.reduceat(np.cross(away, away[towards]), starts, axis=0)


def units(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 3) vectors of length 1, or 0 where they have none."""
    largest = np.abs(vectors).max(axis=1, keepdims=True, initial=0.0)
    scaled = np.divide(vectors, largest, out=np.zeros_like(vectors), where=largest > 0.0)
    length = np.linalg.norm(scaled, axis=1, keepdims=True)
    return np.divide(scaled, length, out=np.zeros_like(vectors), where=length > 0.0)


def wire_tangents(vertices: NDArray[np.float64], wires: NDArray[np.int32]) -> NDArray[np.float64]:
    """(w, 3) the unit vector along each wire; along a chain of a relaxed level all point the same way."""
    return units(vertices[wires[:, 1]] - vertices[wires[:, 0]])
