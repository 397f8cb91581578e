# SPDX-License-Identifier: GPL-3.0-or-later
"""A sample is owned by the point of the skeleton that is nearest, along the axis, to the largest ball at the sample."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Longs
from ..machine import native
from ..samples.analysed import Analysed
from ..shape.nearness import nearest
from .ends import Balls, balls_of
from .spread import graph_of, spread


def owners(samples: Analysed, hierarchy: Any, level: Any) -> tuple[Longs, Balls]:
    """Return the point that owns each sample, and the balls of the samples that each point owns.

    Parameters
    ----------
    samples : Analysed
    hierarchy : _medial.Hierarchy
    level : _medial.Level
        Its vertices are the points.

    Returns
    -------
    owner : (n,) int64
        It is a row of the points. A sample whose ball is not connected to the skeleton gets the owner of the nearest
        sample that has one; if there is none, as on a ball, the nearest point.
    balls : Balls
        Those that end at an opening of the surface are left out: they end where nothing of the solid does.
    """
    graph = graph_of(hierarchy.vertices, hierarchy.edges)
    rows = np.arange(len(level.vertices))
    label, _ = spread(graph, level.vertex_of.astype(np.int64), rows)
    ball = largest_balls(hierarchy, len(samples.points))
    owner = np.where(ball >= 0, label[ball], -1)
    owner = _of_the_nearest(owner, samples)
    left = np.flatnonzero(owner < 0)
    if len(left):
        owner[left] = nearest(samples.points[left], level.vertices)
    touched = np.flatnonzero((ball >= 0) & ~at_openings(samples, hierarchy)[ball])
    vertex = ball[touched]
    found = hierarchy.vertices[vertex], hierarchy.radius[vertex]
    return owner, balls_of(owner[touched], *found, touched, len(rows))


def _of_the_nearest(owner: Longs, samples: Analysed) -> Longs:
    """Return the owners; a sample without one gets that of the nearest sample along Delaunay edges."""
    edges = samples.analysis.edges
    edges = edges[(owner[edges] < 0).any(axis=1)]
    seeds = np.unique(edges[owner[edges] >= 0]).astype(np.int64)
    across, _ = spread(graph_of(samples.points, edges), seeds, owner[seeds])
    return np.where(owner >= 0, owner, across)


def at_openings(samples: Analysed, hierarchy: Any) -> Flags:
    """Return which vertices of the hierarchy, (v,), are balls that touch a sample which closes an opening."""
    found = np.zeros(len(hierarchy.vertices), bool)
    if samples.closing:
        assert samples.kinds is not None
        closing = samples.kinds == int(native.load().SampleKind.OPENING)
        facets = closing[hierarchy.generators].any(axis=1)
        found[hierarchy.facet_vertices[np.repeat(facets, np.diff(hierarchy.facet_offsets))]] = True
    return found


def largest_balls(hierarchy: Any, count: int) -> Longs:
    """Return the vertex of the hierarchy with the largest ball that touches each sample, (n,), or -1."""
    offsets, corners = hierarchy.facet_offsets, hierarchy.facet_vertices
    ball = np.full(count, -1, np.int64)
    if len(offsets) < 2:
        return ball
    radius = hierarchy.radius[corners]
    largest = np.maximum.reduceat(radius, offsets[:-1])
    facet = np.repeat(np.arange(len(largest)), np.diff(offsets))
    # The last one that is written stays: the first of equals, and the largest of all.
    best = np.flatnonzero(radius == largest[facet])[::-1]
    of_facet = np.empty(len(largest), np.int64)
    of_facet[facet[best]] = corners[best]
    order = np.argsort(largest, kind="stable")
    ball[hierarchy.generators[order].ravel()] = np.repeat(of_facet[order], 2)
    return ball


def shares(samples: Analysed) -> tuple[Floats, Floats]:
    """Return the spacing around each sample, (n,), and its share of the surface, (n,); both are 0 for duplicates.

    At sharp edges and isolated samples the umbrella may be as large as the solid, so the spacing is limited to three
    times its median.
    """
    spacing = np.zeros(len(samples.points))
    rows, found = samples.analysis.samples, samples.analysis.spacing
    spacing[rows] = np.minimum(found, 3.0 * float(np.median(found)))
    area = spacing**2
    return spacing, area / area.sum()
