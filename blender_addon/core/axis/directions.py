# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas and normals of facets, and directions of wires."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_BLOCK = (
    1 << 15
)  # so many facets at a time, for their corners take far more memory than their areas


def facet_areas(
    vertices: NDArray[np.float64], offsets: NDArray[np.int32], corners: NDArray[np.int32]
) -> NDArray[np.float64]:
    """(f,) the areas of planar facets; those of others are a little less than their triangles'.

    Parameters
    ----------
    vertices : (v, 3) float64
    offsets : (f + 1,) int32
    corners : (c,) int32
        The corners of facet i are `corners[offsets[i] : offsets[i + 1]]`, in order.
    """
    return 0.5 * np.linalg.norm(_doubled_areas(vertices, offsets, corners), axis=1)


def facet_normals(
    vertices: NDArray[np.float64], offsets: NDArray[np.int32], corners: NDArray[np.int32]
) -> NDArray[np.float64]:
    """(f, 3) the unit normals of facets, which are given as for `facet_areas`; 0 where a facet has no area."""
    largest = float(np.abs(vertices).max(initial=0.0))
    scaled = vertices / largest if largest > 0.0 else vertices  # no square of a huge number
    return _unit(_doubled_areas(scaled, offsets, corners))


def _doubled_areas(
    vertices: NDArray[np.float64], offsets: NDArray[np.int32], corners: NDArray[np.int32]
) -> NDArray[np.float64]:
    """(f, 3) vectors along the normals of facets, twice as long as their areas are large."""
    doubled = np.zeros((len(offsets) - 1, 3))
    for first in range(0, len(doubled), _BLOCK):
        bounds = offsets[first : first + _BLOCK + 1]
        places = vertices[corners[bounds[0] : bounds[-1]]]
        doubled[first : first + _BLOCK] = _sums_of_triangles(places, bounds - bounds[0])
    return doubled


def _sums_of_triangles(
    places: NDArray[np.float64], offsets: NDArray[np.int32]
) -> NDArray[np.float64]:
    starts = offsets[:-1]
    towards = np.arange(1, len(places) + 1)
    towards[offsets[1:] - 1] = starts
    away = places - np.repeat(places[starts], np.diff(offsets), axis=0)
    return np.add.reduceat(np.cross(away, away[towards]), starts, axis=0)


def wire_tangents(vertices: NDArray[np.float64], wires: NDArray[np.int32]) -> NDArray[np.float64]:
    """(w, 3) the unit vector along each wire; along a chain of a relaxed level all point the same way.

    A wire without a length has the vector 0.
    """
    along = vertices[wires[:, 1]] - vertices[wires[:, 0]]
    return _unit(along)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Vectors of length 1 in the same directions; those without a length stay 0."""
    largest = np.abs(vectors).max(axis=1, keepdims=True, initial=0.0)  # no square overflows
    scaled = np.divide(vectors, largest, out=np.zeros_like(vectors), where=largest > 0.0)
    length = np.linalg.norm(scaled, axis=1, keepdims=True)
    return np.divide(scaled, length, out=scaled, where=length > 0.0)
