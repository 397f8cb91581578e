# SPDX-License-Identifier: GPL-3.0-or-later
"""The topology of a triangle mesh, with its areas and volume: uses of edges, components, Euler characteristic."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

Ints = NDArray[np.integer]


def edges(triangles: Ints) -> tuple[Ints, Ints]:
    """(e, 2) distinct edges p < q and in how many triangles each is."""
    pairs = np.concatenate([triangles[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 0))])
    return np.unique(np.sort(pairs, axis=1), axis=0, return_counts=True)


def boundary_edges(triangles: Ints) -> int:
    """Edges that are not used equally often in both directions."""
    pairs = np.concatenate([triangles[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 0))])
    ends = np.sort(pairs, axis=1)
    _, edge = np.unique(ends, axis=0, return_inverse=True)
    return np.count_nonzero(
        np.bincount(edge.reshape(-1), np.where(pairs[:, 0] == ends[:, 0], 1, -1))
    )


def is_oriented(triangles: Ints) -> bool:
    return not boundary_edges(triangles)


def euler(triangles: Ints) -> int:
    """Corners less edges plus triangles."""
    return len(np.unique(triangles)) - len(edges(triangles)[0]) + len(triangles)


def components(triangles: Ints) -> int:
    """Sets of triangles that hang together, if only by a corner."""
    rows, ends = np.unique(edges(triangles)[0], return_inverse=True)
    p, q = ends.reshape(-1, 2).T
    graph = coo_array((np.ones(len(p)), (p, q)), shape=(len(rows), len(rows)))
    return connected_components(graph, directed=False)[0]


def vector_areas(points: NDArray[np.float64], triangles: Ints) -> NDArray[np.float64]:
    """(t, 3) normals of triangles, as long as these are large."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.cross(b - a, c - a) / 2


def area(points: NDArray[np.float64], triangles: Ints) -> float:
    return float(np.linalg.norm(vector_areas(points, triangles), axis=1).sum())


def unit_normals(points: NDArray[np.float64], triangles: Ints) -> NDArray[np.float64]:
    """(t, 3) of triangles that have an area."""
    normals = vector_areas(points, triangles)
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def volume(points: NDArray[np.float64], triangles: Ints) -> float:
    """Enclosed, positive when the triangles face outward."""
    a, b, c = (points[triangles[:, i]] - points.mean(axis=0) for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0
