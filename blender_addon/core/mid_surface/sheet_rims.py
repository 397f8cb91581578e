# SPDX-License-Identifier: GPL-3.0-or-later
"""Rims of straight sheets, carried on to the walls at which the solid ends.

A ray out of the sheet finds the wall of each edge of a rim. At corners of the solid the axis has short edges in any
direction, and edges to vertices on the surface, whose rays find a wrong wall or none. So a wall counts where a stretch
of edges finds it, and the edges between two such stretches take the wall of the nearer one: then their common vertex
is in both walls, which is the corner.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..machine.native import own_errors
from ..shape.triangles import sides_of
from ..small_matrices import dot
from .sheet_chains import Chain, chains_of, nearest_along, runs_of, without_ways_back
from .sheet_faces import ROUNDING
from .sheet_walls import TOUCHES, Walls, reflex_distances
from .thin_sheets import ThinSheets

_REACH = 4.0  # so many radii away the wall at a rim is looked for; chosen: midsurface
_STEPS = 2.0  # times as far as beside it the wall ahead of an edge may be; chosen: midsurface
_ASIDE = 0.05  # in radii: rays beside each other tell the direction of a wall; chosen: midsurface
_LIKE = 0.6  # cosine between the border and the wall that ends a sheet, at least; chosen: unseen
_SMOOTH = 0.8  # cosine between the walls of edges beside each other that are one wall, at least; chosen: midsurface
_LOST = 0.1  # in radii: so near to the wall of an edge is a place beside the corner of two walls; chosen: unseen
_NOTHING, _AT_WALL, _CORNER = range(3)  # what an edge ends at: no wall, a wall ahead, a reflex edge
_LONG = np.array((8.0, 1.5, 0.5))  # in radii: shorter stretches of each kind tell nothing


@dataclass(frozen=True, eq=False)
class RimEdges:
    """The edges at which sheets end."""

    ends: Longs  # (k, 2) Rows of vertices, as the triangle of the edge turns
    part: Ints  # (k,)
    middles: Floats  # (k, 3)
    radius: Floats  # (k,)
    # (k, 3) Unit vectors along each edge and out of its sheet
    along: Floats
    out: Floats

    def of(self, rows: Flags) -> RimEdges:
        return RimEdges(*(getattr(self, field.name)[rows] for field in fields(self)))


@dataclass(frozen=True, eq=False)
class Rims:
    """The edges at which sheets end, and the planes in which they end."""

    edges: RimEdges
    chains: list[Chain]
    kind: Longs  # (k,)
    # (k, 3) Of the wall at each edge; zero normals where there is none
    places: Floats
    normals: Floats

    def planes(self) -> tuple[Longs, Floats, Floats]:
        """Vertices, and places and normals of planes through them."""
        has = self.normals.any(axis=1)
        corner = self.kind == _CORNER
        ends = self.edges.ends
        vertex = np.concatenate((ends[has].T.ravel(), ends[corner].T.ravel()))
        places = (self.places[has],) * 2 + (self.places[corner],) * 2
        normals = (self.normals[has],) * 2 + (self.edges.along[corner],) * 2
        return vertex, np.concatenate(places), np.concatenate(normals)

    def touched(self, count: int) -> Flags:
        """(v,) the vertices at rims, given the number of all."""
        found = np.zeros(count, bool)
        found[self.edges.ends] = True
        return found

    def without_lost_corners(self, straight: Floats, vertices: Floats, walls: Walls) -> Floats:
        """The vertices, but where they were if the planes of two walls meet far away and a wall is not there.

        Between a hole and a rim that are nearer to each other than the plate is thick, the sheet ends. The walls of
        both then face each other nearly, and their planes meet where the hole is no more.
        """
        reach = np.zeros(len(vertices))
        np.maximum.at(reach, self.edges.ends, _REACH * self.edges.radius[:, None])
        way = vertices - straight
        far = (reach > 0.0) & (dot(way, way) > reach * reach)
        rows, end = np.nonzero(far[self.edges.ends] & (self.kind == _AT_WALL)[:, None])
        if not len(rows):
            return vertices
        vertex, normals = self.edges.ends[rows, end], self.normals[rows]
        along = self.edges.along[rows] - dot(self.edges.along[rows], normals)[:, None] * normals
        step = np.where(end == 0, 1.0, -1.0) * self.edges.radius[rows]
        with own_errors() as module:
            away = module.TriangleTree(walls.points, walls.triangles).distances(
                vertices[vertex] + step[:, None] * along
            )
        lost = vertex[np.asarray(away) > _LOST * self.edges.radius[rows]]
        found = vertices.copy()
        found[lost] = straight[lost]
        return found

    def without_ways_back(self, vertices: Floats) -> Floats:
        """The vertices, of which none goes back along a wall."""
        found = vertices.copy()
        across = dot(self.edges.along, self.normals)[:, None] * self.normals
        ways = np.where(self.normals.any(axis=1)[:, None], self.edges.along - across, 0.0)
        for chain in self.chains:
            apart = _apart(chain.rows, chain.closed, self.kind, self.normals)
            for run in runs_of(apart):
                rows = chain.rows[run]
                if not apart.any():  # a loop along one wall begins where it surely goes on
                    rows = np.roll(rows, -1 - self._longest(rows, found))
                around = np.append(self.edges.ends[rows, 0], self.edges.ends[rows[-1], 1])
                found[around] = without_ways_back(found[around], ways[rows])
        return found

    def _longest(self, rows: Longs, vertices: Floats) -> int:
        ends = vertices[self.edges.ends[rows]]
        return int(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).argmax())


def rims(
    sheets: ThinSheets, straight: Floats, normals: Floats, radii: Floats, walls: Walls
) -> Rims:
    """Find the rims of straight sheets and where they end.

    `straight` (v, 3) is where the vertices are in the straight sheets; `normals` (t, 3, 3) and `radii` (t, 3) are those
    of the sheets at the corners of their triangles, half of the thickness.
    """
    edges = _edges(sheets, straight, normals, radii)
    kind, places, ahead = _ends_of(edges, walls)
    chains = chains_of(edges.ends, edges.part)
    for chain in chains:
        rows, like = chain.rows, _like(chain, edges, kind, ahead, straight)
        for values in (kind, places, ahead, edges.along):
            values[rows] = values[np.maximum(like, 0)]
        kind[rows[like < 0]], ahead[rows[like < 0]] = _NOTHING, 0.0
    return Rims(edges, chains, kind, places, ahead)


def single_edges(triangles: Ints) -> tuple[Longs, Longs, Longs]:
    """(k, 2) the edges of one triangle, as it turns, (k,) that triangle and (k,) its side."""
    _, edge, uses = sides_of(triangles)
    triangle, side = np.nonzero(uses[edge] == 1)
    ends = triangles[triangle, side], triangles[triangle, (side + 1) % 3]
    return np.column_stack(ends).astype(np.int64), triangle, side


def _edges(sheets: ThinSheets, straight: Floats, normals: Floats, radii: Floats) -> RimEdges:
    ends, triangle, side = single_edges(sheets.triangles)
    way = straight[ends[:, 1]] - straight[ends[:, 0]]
    length = np.linalg.norm(way, axis=1)
    out = np.cross(way, normals[triangle, side] + normals[triangle, (side + 1) % 3])
    size = np.linalg.norm(out, axis=1)
    radius = 0.5 * (radii[triangle, side] + radii[triangle, (side + 1) % 3])
    has = size > ROUNDING * radius
    return RimEdges(
        ends,
        sheets.part[triangle],
        straight[ends].mean(axis=1),
        radius,
        np.where(has[:, None], way / np.where(has, length, 1.0)[:, None], 0.0),
        np.where(has[:, None], out / np.where(has, size, 1.0)[:, None], 0.0),
    )


def _ends_of(edges: RimEdges, walls: Walls) -> tuple[Longs, Floats, Floats]:
    """Return the kind of thing at which each edge ends, and the place and normal of the plane there.

    That is the wall that a ray out of the sheet meets. At the inner corner of a rim all balls touch the same reflex
    edge. Edges without a length or a ball, steps of the rim, and what a ray leaves without a wall end at nothing.
    """
    kind = np.full(len(edges.ends), _NOTHING)
    places, normals = np.zeros((2, len(kind), 3))
    if not len(kind):
        return kind, places, normals
    with own_errors() as module:
        away = np.asarray(
            module.TriangleTree(walls.points, walls.triangles).distances(edges.middles)
        )
    has = edges.out.any(axis=1) & (edges.radius > 0.0)
    there = has & (away <= TOUCHES * edges.radius)
    # A ray from within finds the wall at which an edge is already.
    places[there], normals[there] = _walls_ahead(edges.of(there), walls, back=1.0)
    kind[normals.any(axis=1)] = _AT_WALL
    has &= ~there
    rim = edges.of(has)
    feet = rim.middles + rim.radius[:, None] * rim.out
    at_edge = reflex_distances(feet, walls) <= 2.0 * TOUCHES * rim.radius
    at, ahead = _walls_ahead(rim, walls)
    met = ahead.any(axis=1) & ~at_edge
    at[at_edge], ahead[at_edge] = feet[at_edge], rim.out[at_edge]
    ahead[~_are_nearest(rim, at, met | at_edge)] = 0.0
    kind[has] = np.where(at_edge, _CORNER, np.where(ahead.any(axis=1), _AT_WALL, _NOTHING))
    places[has], normals[has] = at, ahead
    return kind, places, normals


def _are_nearest(rim: RimEdges, places: Floats, met: Flags) -> Flags:
    """(k,) the edges that met walls not much farther than those of edges beside them: others are steps of the rim."""
    away = np.where(met, np.linalg.norm(places - rim.middles, axis=1), np.inf)
    least = np.full(int(rim.ends.max(initial=-1)) + 1, np.inf)
    np.minimum.at(least, rim.ends, away[:, None])
    return np.asarray(met & (away <= _STEPS * least[rim.ends].min(axis=1)))


def _walls_ahead(rim: RimEdges, walls: Walls, back: float = 0.0) -> tuple[Floats, Floats]:
    """(k, 3) where rays out of the sheets meet a wall, and (k, 3) its unit normal; 0 where there is none.

    Rays start so many radii back within the sheet. Two more rays beside each tell the direction of the wall.
    """
    if not len(rim.ends):
        return np.zeros((0, 3)), np.zeros((0, 3))
    aside = np.cross(rim.along, rim.out)
    step = _ASIDE * rim.radius[:, None]
    start = rim.middles - back * rim.radius[:, None] * rim.out
    starts = np.concatenate((start, start + step * rim.along, start + step * aside))
    with own_errors() as module:
        way = module.wall_distances(
            np.ascontiguousarray(starts),
            np.ascontiguousarray(np.tile(-rim.out, (3, 1))),
            np.tile((_REACH + back) * rim.radius, 3),
            walls.points,
            walls.triangles,
        )
    met = np.isfinite(way).reshape(3, -1).all(axis=0)
    way = np.where(np.isfinite(way), way, 0.0)
    hits = (starts + way[:, None] * np.tile(rim.out, (3, 1))).reshape(3, -1, 3)
    normals = np.cross(hits[1] - hits[0], hits[2] - hits[0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), np.finfo(float).tiny)[:, None]
    normals[~met | (np.abs(dot(normals, rim.out)) < _LIKE)] = 0.0
    return hits[0], normals


def _apart(rows: Longs, closed: bool, kind: Longs, normals: Floats) -> Flags:
    """(k,) the edges whose wall is not that of the edge before; the first of an open chain is one."""
    one, two = np.roll(rows, 1), rows
    turns = dot(normals[one], normals[two]) < _SMOOTH
    apart = (kind[one] != kind[two]) | ((kind[two] == _AT_WALL) & turns)
    apart[:1] |= not closed
    return np.asarray(apart)


def _like(chain: Chain, edges: RimEdges, kind: Longs, normals: Floats, straight: Floats) -> Longs:
    """(k,) the edge whose wall each edge of a chain takes: its own in long stretches, else that of the nearest.

    -1 where that is too far away.
    """
    rows, closed = chain.rows, chain.closed
    # Edges without a wall count in long stretches only, and a stretch of a wall goes on beyond short ones.
    counts = _long(rows, closed, edges, kind, normals, straight)
    counts |= (kind[rows] == _AT_WALL) | (kind[rows] == _CORNER)
    sites = np.flatnonzero(counts)
    sites = sites[_long(rows[sites], closed, edges, kind, normals, straight)]
    if not len(sites):
        return np.where(counts, rows, -1)
    lengths = np.linalg.norm(straight[edges.ends[rows, 1]] - straight[edges.ends[rows, 0]], axis=1)
    nearest = rows[nearest_along(lengths, sites, closed)]
    away = np.linalg.norm(edges.middles[nearest] - edges.middles[rows], axis=1)
    near = away <= _REACH * edges.radius[rows] + lengths
    return np.where(near, nearest, np.where(counts, rows, -1))


def _long(
    rows: Longs, closed: bool, edges: RimEdges, kind: Longs, normals: Floats, straight: Floats
) -> Flags:
    """(k,) the edges of stretches that are long enough to tell where their sheet ends."""
    long = np.zeros(len(rows), bool)
    for run in runs_of(_apart(rows, closed, kind, normals)):
        of = rows[run]
        away = straight[edges.ends[of]].reshape(-1, 3) - straight[edges.ends[of[0], 0]]
        if kind[of[0]] == _AT_WALL:
            away -= dot(away, normals[of[0]])[:, None] * normals[of[0]]
        extent = np.linalg.norm(away, axis=1).max()
        long[run] = extent >= _LONG[kind[of[0]]] * edges.radius[of].mean()
    return long
