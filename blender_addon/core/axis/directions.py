# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas of facets, and at each vertex the normal of its sheet and the direction of its curve."""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..machine.native import own_errors
from ..small_matrices import summed, times


def facet_areas(vertices: Floats, offsets: Ints, corners: Ints) -> Floats:
    """Return the areas of planar facets, (f,); those of others are a little less than their triangles'.

    The (v, 3) vertices are those of all facets; the corners of facet i are `corners[offsets[i] : offsets[i + 1]]`, in
    order.
    """
    return 0.5 * np.linalg.norm(_doubled_areas(vertices, offsets, corners), axis=1)


def facet_normals(vertices: Floats, offsets: Ints, corners: Ints) -> Floats:
    """Return the unit normals of facets, (f, 3), which are given as for `facet_areas`; 0 where a facet has no area."""
    return _unit(_doubled_areas(_scaled(vertices), offsets, corners))


def sheet_normals(vertices: Floats, offsets: Ints, corners: Ints, part: Ints) -> Floats:
    """Return the unit normal of the sheet at each vertex, (v, 3), the mean over the facets of one part, by area.

    A vertex on a seam has that of the part with the largest area round it, of equal ones the lowest. Where facets of a
    part look opposite ways, as where a part with one side only must turn over, it is that of the largest facet. A
    vertex on no facet that has an area has the vector 0.

    Facets are given as for `facet_areas`, with the (f,) part of each, from 0; those of a part turn the same way.
    """
    doubled = _doubled_areas(_scaled(vertices), offsets, corners)
    area = np.linalg.norm(doubled, axis=1)
    facet = np.repeat(np.arange(len(part)), np.diff(offsets))
    own = _part_of_vertices(len(vertices), corners, part[facet], area[facet])
    kept = own[corners] == part[facet]
    facet, vertex = facet[kept], corners[kept]
    total = summed(vertex, doubled[facet], len(vertices))
    whole = np.bincount(vertex, area[facet], len(vertices))
    opposed = np.linalg.norm(total, axis=1) < 0.5 * whole
    there = np.flatnonzero(opposed[vertex])
    by_area = there[np.argsort(area[facet[there]], kind="stable")]
    total[vertex[by_area]] = doubled[facet[by_area]]  # the last one stays
    return _unit(total)


def _part_of_vertices(count: int, vertex: Ints, part: Ints, area: Floats) -> Ints:
    """Return the part with the largest area at each vertex, (count,), of corners with a vertex, a part and an area."""
    own = np.full(count, -1, np.int32)
    own[vertex] = part
    several = np.zeros(count, np.bool_)
    several[vertex[own[vertex] != part]] = True
    there = np.flatnonzero(several[vertex])  # sorting all corners would take far longer
    parts = int(part.max(initial=0)) + 1
    pairs, row = np.unique(
        vertex[there].astype(np.int64) * parts + part[there], return_inverse=True
    )
    areas = np.bincount(row, area[there], len(pairs))
    order = np.lexsort((-pairs, areas))
    own[pairs[order] // parts] = pairs[order] % parts  # the last one stays
    return own


def _doubled_areas(vertices: Floats, offsets: Ints, corners: Ints) -> Floats:
    """Return vectors along the normals of facets, (f, 3), twice as long as their areas are large."""
    with own_errors() as module:
        return np.asarray(module.polygon_areas(vertices, offsets, corners))


def corners_after(offsets: Ints) -> Longs:
    """Return the corner after each corner of a facet, (c,), whose corners begin at (f + 1,) `offsets`."""
    after = np.arange(1, int(offsets[-1]) + 1)
    after[offsets[1:] - 1] = offsets[:-1]
    return after


def curve_tangents(vertices: Floats, wires: Ints) -> Floats:
    """Return the unit direction of the curve at each vertex, (v, 3), the same way along a chain of a relaxed level.

    At a fork it is that of the two of the (w, 2) wires that go straightest through it. A vertex without a wire has the
    vector 0.
    """
    along = _unit(vertices[wires[:, 1]] - vertices[wires[:, 0]])
    ends = wires.T.ravel()
    total = summed(ends, np.concatenate([along, along]), len(vertices))
    degree = np.bincount(ends, minlength=len(vertices))
    order, starts = np.argsort(ends, kind="stable"), np.cumsum(degree) - degree
    for row in np.flatnonzero(degree > 2).tolist():
        at = order[starts[row] : starts[row] + degree[row]]
        total[row] = _straightest(along[at % len(wires)], at < len(wires))
    return _unit(total)


def _straightest(along: Floats, leaves: Flags) -> Floats:
    """The direction through a fork, of the (n, 3) directions of its wires, which leave it or end there."""
    away = np.where(leaves[:, None], along, -along)
    first, last = divmod(int(np.argmin(times(away, away))), len(away))
    through = away[last] - away[first]
    return through if leaves[last] else -through


def _scaled(vertices: Floats) -> Floats:
    """The vertices with coordinates up to 1, so that no square of them overflows."""
    largest = float(np.abs(vertices).max(initial=0.0))
    return vertices / largest if largest > 0.0 else vertices


def _unit(vectors: Floats) -> Floats:
    """Vectors of length 1 in the same directions; those without a length stay 0."""
    largest = np.abs(vectors).max(axis=1, keepdims=True, initial=0.0)  # no square overflows
    scaled = np.divide(vectors, largest, out=np.zeros_like(vectors), where=largest > 0.0)
    length = np.linalg.norm(scaled, axis=1, keepdims=True)
    return np.divide(scaled, length, out=scaled, where=length > 0.0)
