# SPDX-License-Identifier: GPL-3.0-or-later
"""Betti numbers of polygons, edges and points, over the field of two elements; they need not be a manifold.

A closed surface with two polygons at an edge has both or none of them. So polygons that an edge joins alone are one
patch, polygons with a free edge are in no closed surface, and what remains to be eliminated is small.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .read_axis import Complex

Ints = NDArray[np.int64]


def betti(found: Complex) -> tuple[int, int, int]:
    """Components, tunnels and cavities."""
    pairs = found.corner_edges if found.faces else np.empty((0, 2), np.int64)
    sides, edge = np.unique(pairs, axis=0, return_inverse=True)
    edges = np.concatenate((sides, found.edges))
    vertices = len(found.vertices)
    pieces = _components(vertices, edges)
    cavities = closed_surfaces(np.diff(found.offsets), edge.reshape(-1))
    euler = vertices - len(edges) + found.faces
    return pieces, pieces + cavities - euler, cavities


def closed_surfaces(sizes: Ints, edge: Ints) -> int:
    """Dimension of the sets of polygons that meet every edge an even number of times; `edge` says which edge goes out
    from each corner, `sizes` how many corners each polygon has."""
    face = np.repeat(np.arange(len(sizes)), sizes)
    there = _without_free_edges(len(sizes), face, edge)
    face, edge = face[there[face]], edge[there[face]]
    if len(face) == 0:
        return 0
    uses = np.bincount(edge)
    order = np.argsort(edge, kind="stable")
    twice = order[uses[edge[order]] == 2].reshape(-1, 2)
    graph = coo_array(
        (np.ones(len(twice)), (face[twice[:, 0]], face[twice[:, 1]])), (len(sizes), len(sizes))
    )
    patch = connected_components(graph, directed=False)[1]
    patches = np.unique(patch[there], return_inverse=True)[0]
    column = np.searchsorted(patches, patch)
    odd = order[uses[edge[order]] > 2]
    return len(patches) - _rank(_junctions(edge[odd], column[face[odd]]))


def _without_free_edges(count: int, face: Ints, edge: Ints) -> NDArray[np.bool_]:
    """(count,) bool: polygons that are left when those with an edge of their own go, again and again."""
    there = np.ones(count, bool)
    while len(face):
        going = np.unique(face[np.bincount(edge)[edge] == 1])
        if len(going) == 0:
            break
        there[going] = False
        kept = there[face]
        face, edge = face[kept], edge[kept]
    return there


def _junctions(edge: Ints, column: Ints) -> set[frozenset[int]]:
    """Patches that meet an edge an odd number of times, for each edge."""
    found: set[frozenset[int]] = set()
    if len(edge) == 0:
        return found
    for group in np.split(column, np.flatnonzero(np.diff(edge)) + 1):
        values, counts = np.unique(group, return_counts=True)
        found.add(frozenset(values[counts % 2 == 1].tolist()))
    return found - {frozenset()}


def _rank(rows: set[frozenset[int]]) -> int:
    """Over the field of two elements; a pivot is the largest of its row."""
    pivots: dict[int, frozenset[int]] = {}
    for start in rows:
        row = start
        while row:
            pivot = max(row)
            if pivot not in pivots:
                pivots[pivot] = row
                break
            row = row ^ pivots[pivot]
    return len(pivots)


def _components(vertices: int, edges: Ints) -> int:
    p, q = edges.T
    graph = coo_array((np.ones(len(p)), (p, q)), shape=(vertices, vertices))
    return int(connected_components(graph, directed=False)[0])
