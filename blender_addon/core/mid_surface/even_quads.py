# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets of even quadrilaterals: a grid in flat sheets with four corners, pairs of even triangles in all others."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..axis.directions import corners_after
from ..machine.progress import Progress
from ..small_matrices import dot
from .even_triangles import even_triangles
from .quad_pairs import LEAST_SINE, least_sines, paired
from .sheet_faces import ROUNDING, SheetFaces

# Places, (k, 4) rows of these with -1 where a face is a triangle, and the sheets of the faces.
_Made = tuple[Floats, Longs, Ints]

_STRAIGHT = 0.94  # the cosine of the turn at a corner of a polygon that is none of the sheet's; chosen: unseen


def even_quads(faces: SheetFaces, length: float, progress: Progress | None = None) -> SheetFaces:
    """Remesh sheets to quadrilaterals, and to triangles where these do not fit; sheets that share edges still do.

    Neighbours of the same sheet turn the same way; `length` is that of the edges that are wanted.
    """
    faces = _with_borders_divided(faces, length)
    alone = np.bincount(faces.part)[faces.part] == 1
    found = {face: _grid(faces.ring(face)) for face in np.flatnonzero(alone)}
    grids = {face: grid for face, grid in found.items() if grid is not None}
    made: list[_Made] = [
        (places, quads, np.full(len(quads), faces.part[face], np.int32))
        for face, (places, quads) in grids.items()
    ]
    rest = ~np.isin(faces.of, list(grids))
    if rest.any():
        triangles, part = faces.triangles[rest], faces.part[faces.of[rest]]
        points, triangles, part = even_triangles(faces.vertices, triangles, part, length, progress)
        quads, part = paired(points, triangles, part)
        made.append((points, quads, part))
    return _together(made)


def _with_borders_divided(faces: SheetFaces, length: float) -> SheetFaces:
    """The same faces with more corners: borders of sheets have edges of equal lengths, no longer than wanted."""
    corners = faces.corners
    after = corners_after(faces.offsets)
    ends = np.sort(np.column_stack((corners, corners[after])), axis=1)
    edges, edge = np.unique(ends, axis=0, return_inverse=True)
    edge = edge.reshape(-1)
    owner = np.repeat(faces.part, np.diff(faces.offsets))
    low, high = np.full(len(edges), owner.max() + 1), np.full(len(edges), -1)
    np.minimum.at(low, edge, owner)
    np.maximum.at(high, edge, owner)
    is_border = (np.bincount(edge) != 2) | (low != high)
    way = faces.vertices[edges[:, 1]] - faces.vertices[edges[:, 0]]
    pieces = np.ceil(np.linalg.norm(way, axis=1) / length - ROUNDING).astype(np.int64)
    more = np.where(is_border, np.maximum(pieces - 1, 0), 0)
    first = len(faces.vertices) + np.cumsum(more) - more
    share = _counted(more) + 1
    of = np.repeat(np.arange(len(edges)), more)
    new = faces.vertices[edges[of, 0]] + (share / (more[of] + 1))[:, None] * way[of]
    each = more[edge]
    at, step = np.repeat(np.arange(len(corners)), each + 1), _counted(each + 1)
    forward = corners[at] == edges[edge[at], 0]
    between = first[edge[at]] + np.where(forward, step - 1, each[at] - step)
    rows = np.where(step == 0, corners[at], between).astype(np.int32)
    sizes = np.add.reduceat(each + 1, faces.offsets[:-1])
    offsets = np.concatenate(([0], np.cumsum(sizes))).astype(np.int32)
    return SheetFaces(np.concatenate((faces.vertices, new)), offsets, rows, faces.part)


def _counted(counts: Longs) -> Longs:
    """0, 1, ... up to each of the counts, one after the other."""
    return np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)


def _grid(ring: Floats) -> tuple[Floats, Longs] | None:
    """(n, 3) places and (q, 4) quadrilaterals of a grid between (r, 3) places round a face, whose edges it keeps.

    None where the ring has not four corners, or opposite sides have other numbers of edges.
    """
    along = np.roll(ring, -1, axis=0) - ring
    along /= np.maximum(np.linalg.norm(along, axis=1), np.finfo(float).tiny)[:, None]
    turns = np.flatnonzero(dot(np.roll(along, 1, axis=0), along) < _STRAIGHT)
    if len(turns) != 4:
        return None
    ring = np.roll(ring, -turns[0], axis=0)
    u, v, back, down = np.diff(np.append(turns, turns[0] + len(ring))).tolist()
    if u != back or v != down:
        return None
    ring = np.concatenate((ring, ring[:1]))
    low, high = ring[: u + 1], ring[u + v : 2 * u + v + 1][::-1]
    places = _filled(low, high, ring[2 * u + v :][::-1], ring[u : u + v + 1]).reshape(-1, 3)
    at = np.arange(len(places)).reshape(u + 1, v + 1)
    quads = np.stack((at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]), axis=2).reshape(-1, 4)
    return (places, quads) if least_sines(places[quads]).min() >= LEAST_SINE else None


def _filled(low: Floats, high: Floats, left: Floats, right: Floats) -> Floats:
    """(u + 1, v + 1, 3) places between two sides of u and two of v edges (Coons 1967)."""
    s: Floats = np.linspace(0.0, 1.0, len(low))[:, None, None]
    t: Floats = np.linspace(0.0, 1.0, len(left))[None, :, None]
    across = (1.0 - t) * low[:, None] + t * high[:, None]
    along = (1.0 - s) * left[None] + s * right[None]
    ends = (1.0 - t) * low[[0, -1], None] + t * high[[0, -1], None]
    places: Floats = across + along - (1.0 - s) * ends[:1] - s * ends[1:]
    places[:, 0], places[:, -1], places[0], places[-1] = low, high, left, right
    return places


def _together(made: list[_Made]) -> SheetFaces:
    """One list of faces, ordered by sheets; places on borders that sheets share are one vertex."""
    starts = np.cumsum([0] + [len(places) for places, _, _ in made])
    points, row = np.unique(
        np.concatenate([places for places, _, _ in made]), axis=0, return_inverse=True
    )
    row = np.append(row.reshape(-1), -1)
    faces = np.concatenate(
        [
            row[np.where(each < 0, -1, each + start)]
            for (_, each, _), start in zip(made, starts, strict=False)
        ]
    )
    part = np.concatenate([each for _, _, each in made]).astype(np.int32)
    order = np.argsort(part, kind="stable")
    faces, part = faces[order], part[order]
    offsets = np.concatenate(([0], np.cumsum((faces >= 0).sum(axis=1)))).astype(np.int32)
    return SheetFaces(points, offsets, faces[faces >= 0].astype(np.int32), part)
