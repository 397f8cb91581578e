# SPDX-License-Identifier: GPL-3.0-or-later
"""This module finds the nearest seed of each vertex of a graph, along its edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..small_matrices import dot
from ..united import united

# The front advances by this many mean edge lengths at a time; small steps reach few vertices twice.
_STEP = 2.0  # work: time


@dataclass(frozen=True, eq=False)
class Graph:
    """A graph lists edges by vertex: those of vertex v are the rows first[v] : first[v + 1] of `to` and `length`."""

    first: Longs
    to: Longs
    length: Floats


def graph_of(points: Floats, edges: Ints) -> Graph:
    """Return the graph of (e, 2) edges between (n, 3) points, with their lengths in space."""
    ends = np.ascontiguousarray(edges.T)
    along = points[ends[0]] - points[ends[1]]
    length = np.sqrt(dot(along, along))
    counts = [np.bincount(end, minlength=len(points)) for end in ends]
    first = np.zeros(len(points) + 1, np.int64)
    np.cumsum(counts[0] + counts[1], out=first[1:])
    to, far = np.empty(2 * len(edges), np.int64), np.empty(2 * len(edges))
    start = first[:-1]
    for here, there, count in zip(ends, ends[::-1], counts, strict=True):
        order = np.argsort(
            here, kind="stable"
        )  # each column of the edges is sorted by itself, because it is partly sorted already
        row = np.arange(len(edges)) + np.repeat(start - (np.cumsum(count) - count), count)
        to[row], far[row] = there[order], length[order]
        start = start + count
    return Graph(first, to, far)


def spread(
    graph: Graph, seeds: Longs, labels: Longs, within: float = np.inf
) -> tuple[Longs, Floats]:
    """Return the label of the nearest seed of each vertex, and its distance.

    Parameters
    ----------
    graph : Graph
    seeds : (s,) vertices; if a vertex is named several times, its lowest label counts.
    labels : (s,) integers, not negative
    within : float
        The search ends at this distance.

    Returns
    -------
    label : (n,) int64
        It is -1 if no seed can be reached. Of two equally near seeds the lower label counts.
    distance : (n,) float64
        It is infinite if no seed can be reached.
    """
    count = len(graph.first) - 1
    distance, label = np.full(count, np.inf), np.full(count, -1, np.int64)
    step = _STEP * float(graph.length.mean()) if len(graph.length) else 0.0
    front, at, marks = seeds, np.zeros(len(seeds)), labels
    while len(front):
        near = at <= at.min() + step
        later = front[~near], at[~near], marks[~near]
        front, at, marks = _best(front[near], at[near], marks[near])
        nearer = (at < distance[front]) | ((at == distance[front]) & (marks < label[front]))
        front, at, marks = front[nearer], at[nearer], marks[nearer]
        distance[front], label[front] = at, marks
        rows, count_of = _edges_of(graph, front)
        front, at = graph.to[rows], np.repeat(at, count_of) + graph.length[rows]
        marks = np.repeat(marks, count_of)
        hopeful = (at <= distance[front]) & (at <= within)
        front, at, marks = (
            np.concatenate((old, new[hopeful]))
            for old, new in zip(later, (front, at, marks), strict=True)
        )
    return label, distance


def _best(front: Longs, at: Floats, marks: Longs) -> tuple[Longs, Floats, Longs]:
    """Return each vertex of the front once, with its smallest distance and then its lowest label."""
    order = np.lexsort((marks, at, front))
    front, at, marks = front[order], at[order], marks[order]
    first = np.ones(len(front), bool)
    first[1:] = front[1:] != front[:-1]
    return front[first], at[first], marks[first]


def _edges_of(graph: Graph, vertices: Longs) -> tuple[Longs, Longs]:
    """Return the rows of the edges of vertices, one vertex after the other, and their number for each vertex."""
    start, count = graph.first[vertices], graph.first[vertices + 1] - graph.first[vertices]
    before = np.cumsum(count) - count
    return np.arange(int(count.sum()), dtype=np.int64) + np.repeat(start - before, count), count


def groups_of(rows: Longs, edges: Ints) -> Longs:
    """Return the number of the connected group of each row, (r,), from 0; only edges between two of the rows count.

    The rows ascend, and the edges are (e, 2).
    """
    at = np.full(max(int(rows.max(initial=-1)), int(edges.max(initial=-1))) + 1, -1, np.int64)
    at[rows] = np.arange(len(rows))
    pairs = at[edges[(at[edges] >= 0).all(axis=1)]]
    return np.unique(united(len(rows), pairs), return_inverse=True)[1].reshape(-1).astype(np.int64)
