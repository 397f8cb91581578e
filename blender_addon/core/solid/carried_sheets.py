# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets of walls carried on straight: where balls touch reflex edges, to the line where sheets meet, and at rims to
the wall at the end.

The medial axis bulges where walls meet, because the ball there touches the edge between them and no face, and it ends
half a thickness before the wall at a rim. Each vertex there moves by the least way to where the planes of its sheets,
and the walls at its rims, meet.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..machine.native import own_errors
from ..small_matrices import dot, shortest_solutions

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .thin_sheets import ThinSheets

_TOUCHES = 0.01  # a ball whose distance from an edge differs by less than this share of its radius touches it
_REACH = 4.0  # so many radii away the wall at a rim is looked for
_STEPS = (
    2.0  # so many times as far as that of an edge beside it the wall ahead of an edge is at most
)
_ASIDE = 0.05  # in radii: rays beside each other tell the direction of a wall
_LIKE = 0.6  # cosine between the border and the wall that ends a sheet, at least
_LAST = 2  # so many vertices at the end of a bend may be in one of its sheets only
_RINGS = 3  # so many rings of facets round a bent one tell nothing either
_SHORT = 1e-6  # in radii: a shorter edge has no direction
_PLANE = 0.02  # planes whose directions differ by less do not determine where they meet


@dataclass(frozen=True, eq=False)
class Walls:
    """The faces of a solid, outward, and the rows of the ends of its reflex edges, (e, 2)."""

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    reflex: NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class CarriedSheets:
    """Sheets that reach the walls and each other.

    Parameters
    ----------
    vertices : (v, 3) float64
    triangles : (t, 3) int32
    part : (t,) int32
    at_corners : (t, 3) float64
        The thickness of the sheet of each triangle at its corners.
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int32]
    part: NDArray[np.int32]
    at_corners: NDArray[np.float64]


def carried(sheets: ThinSheets, walls: Walls) -> CarriedSheets:
    """Carry the sheets on to where they meet and to the walls."""
    away = _reflex_distances(sheets.vertices, walls)
    bent = sheets.at_edge | (away <= (1.0 + _TOUCHES) * sheets.radius)
    planes = _Planes(sheets, bent)
    rows = _Rows(len(sheets.vertices))
    rows.add(planes.vertex, planes.places, planes.normals)
    rows.add(*planes.at_ends_of_bends(sheets))
    straight = rows.solved(sheets.vertices)
    _add_rims(rows, _rim(sheets, straight, planes, walls), bent, walls)
    vertices = rows.solved(straight)
    return CarriedSheets(
        vertices, sheets.triangles, sheets.part, planes.thickness_at_corners(vertices)
    )


def _reflex_distances(points: NDArray[np.float64], walls: Walls) -> NDArray[np.float64]:
    """(n,) how far points are from the nearest reflex edge; infinite where the solid has none."""
    if not len(walls.reflex) or not len(points):
        return np.full(len(points), np.inf)
    edges = np.ascontiguousarray(walls.reflex[:, [0, 1, 1]].astype(np.int32))
    with own_errors() as module:
        return np.asarray(
            module.surface_distances(np.ascontiguousarray(points), walls.points, edges)
        )


def _clear(sheets: ThinSheets, bent: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(t,) the triangles whose facets lie between faces as a whole, and are some rings away from others.

    In a sheet that is not so wide they are as many rings away as there are.
    """
    unclear = bent[sheets.triangles].any(axis=1) | ~sheets.facing
    away = np.where(unclear, 0, _RINGS + 1)
    for ring in range(1, _RINGS + 2):
        of_facets = np.zeros(int(sheets.facet.max()) + 1, bool)
        of_facets[sheets.facet[unclear]] = True
        at = np.zeros(len(bent), bool)
        at[sheets.triangles[of_facets[sheets.facet]]] = True
        unclear = at[sheets.triangles].any(axis=1)
        away[unclear] = np.minimum(away[unclear], ring - 1)
    away[sheets.sliver] = 0
    most = np.zeros(sheets.parts, np.int64)
    np.maximum.at(most, sheets.part, away)
    return np.asarray((away > 0) & (away == most[sheets.part]))


class _Planes:
    """The plane in which a sheet goes on at each of its vertices, and its thickness there.

    Where the balls touch a reflex edge, and at sharp convex edges, it is that of the nearest vertex of the same sheet
    whose facets are between faces.
    """

    def __init__(self, sheets: ThinSheets, bent: NDArray[np.bool_]) -> None:
        count = len(sheets.vertices)
        key = sheets.part[:, None] * np.int64(count) + sheets.triangles
        pairs, of_corner = np.unique(key, return_inverse=True)
        self._of_corner = of_corner.reshape(key.shape)
        part, self.vertex = np.divmod(pairs, count)
        known, normals, slopes = self._means(sheets, bent)
        site = self._sites(sheets.vertices, part, known)
        self.places, self.normals = sheets.vertices[self.vertex[site]], normals[site]
        self._radius, self._slopes = sheets.radius[self.vertex[site]], slopes[site]

    def at_ends_of_bends(
        self, sheets: ThinSheets
    ) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
        """Vertices, and places and normals of planes through them.

        Two sheets that meet at a sharp convex edge may have its last vertices in one of them only. These are in the
        plane of the other sheet, too, as the vertex before them is.
        """
        sides = np.stack((sheets.triangles, np.roll(sheets.triangles, -1, axis=1)), axis=2)
        sides = sides.reshape(-1, 2).astype(np.int64)
        sides = sides[sheets.at_edge[sides].all(axis=1)]
        sides = np.unique(np.concatenate((sides, sides[:, ::-1])), axis=0)
        count = np.bincount(self.vertex, minlength=len(sheets.vertices))
        like = np.where(count > 1, np.arange(len(count)), -1)
        for _ in range(_LAST):
            new = sides[(like[sides[:, 0]] < 0) & (like[sides[:, 1]] >= 0)]
            like[new[:, 0]] = like[new[:, 1]]
        vertex = np.flatnonzero((like >= 0) & (count == 1))
        order = np.argsort(self.vertex, kind="stable")
        first = np.searchsorted(self.vertex[order], like[vertex])
        many = count[like[vertex]]
        within = np.arange(many.sum()) - np.repeat(np.cumsum(many) - many, many)
        pair, vertex = order[np.repeat(first, many) + within], np.repeat(vertex, many)
        away = sheets.vertices[vertex] - self.places[pair]
        depth = np.abs(dot(away, self.normals[pair]))
        near = depth <= (1.0 + _TOUCHES) * self._radius[pair]  # on the wall, as at a bend
        return vertex[near], self.places[pair[near]], self.normals[pair[near]]

    def _means(
        self, sheets: ThinSheets, bent: NDArray[np.bool_]
    ) -> tuple[NDArray[np.bool_], NDArray[np.float64], NDArray[np.float64]]:
        """Whether each pair of sheet and vertex has facets between faces, and their mean normal and slope."""
        a, b, c = (sheets.vertices[sheets.triangles[:, i]] for i in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        clear = _clear(sheets, bent)
        weight = np.where(clear, area, 0.0)
        total = np.zeros(len(self.vertex))
        sums = np.zeros((2, len(self.vertex), 3))
        for corner in range(3):
            rows = self._of_corner[:, corner]
            np.add.at(total, rows, weight)
            for each, values in zip(sums, (sheets.normals, sheets.slopes), strict=True):
                np.add.at(each, rows, weight[:, None] * values)
        known = total > 0.0
        length = np.linalg.norm(sums[0], axis=1)
        known &= length > 0.0
        normals = sums[0] / np.where(known, length, 1.0)[:, None]
        return known, normals, sums[1] / np.where(known, total, 1.0)[:, None]

    def _sites(
        self, vertices: NDArray[np.float64], part: NDArray[np.int64], known: NDArray[np.bool_]
    ) -> NDArray[np.int64]:
        """The pair from which each pair has its plane: itself, or the nearest known one of its sheet."""
        site = np.arange(len(part))
        for number in np.unique(part[~known]):
            mine = part == number
            sites = np.flatnonzero(mine & known)
            rows = np.flatnonzero(mine & ~known)
            if len(sites):
                at = np.ascontiguousarray(vertices[self.vertex[sites]])
                with own_errors() as module:
                    nearest = module.nearest(at, np.ascontiguousarray(vertices[self.vertex[rows]]))
                site[rows] = sites[nearest]
        return site

    def thickness_at_corners(self, vertices: NDArray[np.float64]) -> NDArray[np.float64]:
        """(t, 3) the thickness where the sheets are carried to."""
        return 2.0 * self._radii(vertices)[self._of_corner]

    def _radii(self, vertices: NDArray[np.float64]) -> NDArray[np.float64]:
        away = vertices[self.vertex] - self.places
        return np.maximum(self._radius + dot(self._slopes, away), 0.0)

    def normals_at(
        self, triangle: NDArray[np.int64], side: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """(k, 3) the sums of the normals at the ends of sides of triangles."""
        return self._both(self.normals, triangle, side)

    def radii_at(
        self, vertices: NDArray[np.float64], triangle: NDArray[np.int64], side: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """(k,) the mean radius of sides of triangles."""
        return 0.5 * self._both(self._radii(vertices), triangle, side)

    def _both(
        self, values: NDArray[np.float64], triangle: NDArray[np.int64], side: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        pairs = self._of_corner
        return values[pairs[triangle, side]] + values[pairs[triangle, (side + 1) % 3]]


class _Rows:
    """Planes in which vertices shall lie."""

    def __init__(self, count: int) -> None:
        self._squares = np.zeros((count, 3, 3))
        self._targets = np.zeros((count, 3))

    def add(
        self,
        vertex: NDArray[np.int64],
        places: NDArray[np.float64],
        normals: NDArray[np.float64],
    ) -> None:
        np.add.at(self._squares, vertex, normals[:, :, None] * normals[:, None, :])
        offset = dot(normals, places)
        np.add.at(self._targets, vertex, normals * offset[:, None])

    def solved(self, start: NDArray[np.float64]) -> NDArray[np.float64]:
        """(v, 3) the places in all planes of each vertex that are nearest to where it is."""
        lack = self._targets - dot(self._squares, start[:, None])
        return start + shortest_solutions(self._squares, lack, _PLANE)


@dataclass(frozen=True, eq=False)
class _Rim:
    """The edges at which sheets end, with their rows of vertices, (k, 2).

    The middles, the radii and the unit vectors along each edge and out of its sheet are those of the straight sheets.
    """

    ends: NDArray[np.int64]
    part: NDArray[np.int32]
    middles: NDArray[np.float64]
    radius: NDArray[np.float64]
    along: NDArray[np.float64]
    out: NDArray[np.float64]

    def of(self, rows: NDArray[np.bool_]) -> _Rim:
        return _Rim(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))


def _rim(sheets: ThinSheets, straight: NDArray[np.float64], planes: _Planes, walls: Walls) -> _Rim:
    """The edges of one triangle that have a length and a ball, and are not at a wall."""
    edges = np.stack((sheets.triangles, np.roll(sheets.triangles, -1, axis=1)), axis=2)
    keys = np.sort(edges.reshape(-1, 2), axis=1).astype(np.int64) @ (len(straight), 1)
    _, edge, uses = np.unique(keys, return_inverse=True, return_counts=True)
    triangle, side = np.divmod(np.flatnonzero(uses[edge] == 1), 3)
    ends = edges[triangle, side].astype(np.int64)
    way = straight[ends[:, 1]] - straight[ends[:, 0]]
    length = np.linalg.norm(way, axis=1)
    out = np.cross(way, planes.normals_at(triangle, side))
    size = np.linalg.norm(out, axis=1)
    radius = planes.radii_at(straight, triangle, side)
    middles = straight[ends].mean(axis=1)
    with own_errors() as module:
        away = np.asarray(module.surface_distances(middles, walls.points, walls.triangles))
    has = (size > _SHORT * radius) & (away > _TOUCHES * radius) & (radius > 0.0)
    return _Rim(
        ends,
        sheets.part[triangle],
        middles,
        radius,
        way / np.where(has, length, 1.0)[:, None],
        out / np.where(has, size, 1.0)[:, None],
    ).of(has)


def _add_rims(rows: _Rows, rim: _Rim, bent: NDArray[np.bool_], walls: Walls) -> None:
    """Add the walls at which the sheets end to the planes of the vertices at rims.

    That is the wall that a ray out of the sheet meets; where it meets none, that of the nearest edge whose balls are
    between faces; else the ball touches it. At the inner corner of a rim all balls touch the same reflex edge.
    """
    if not len(rim.ends):
        return
    feet = rim.middles + rim.radius[:, None] * rim.out
    at_edge = _reflex_distances(feet, walls) <= 2.0 * _TOUCHES * rim.radius
    places, normals = _walls_ahead(rim, rim.out, walls)
    found = normals.any(axis=1) & ~at_edge
    like = _nearest_clear(rim, found & ~bent[rim.ends].any(axis=1))
    again = ~found & ~at_edge & (like >= 0)
    if again.any():
        places[again], normals[again] = _walls_ahead(rim.of(again), rim.out[like[again]], walls)
    alone = at_edge | ~normals.any(axis=1)
    places[alone], normals[alone] = feet[alone], rim.out[alone]
    near = again | _are_nearest(rim, places)
    for end in range(2):
        rows.add(rim.ends[near, end], places[near], normals[near])
        rows.add(rim.ends[at_edge, end], feet[at_edge], rim.along[at_edge])


def _are_nearest(rim: _Rim, places: NDArray[np.float64]) -> NDArray[np.bool_]:
    """(k,) the edges whose walls are not much farther than those of edges beside them: others are steps of the rim."""
    away = np.linalg.norm(places - rim.middles, axis=1)
    least = np.full(int(rim.ends.max()) + 1, np.inf)
    np.minimum.at(least, rim.ends, away[:, None])
    return np.asarray(away <= _STEPS * least[rim.ends].min(axis=1))


def _walls_ahead(
    rim: _Rim, out: NDArray[np.float64], walls: Walls
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(k, 3) where rays out of the sheets meet a wall, and (k, 3) its unit normal; 0 where there is none.

    Two more rays beside each tell the direction of the wall.
    """
    aside = np.cross(rim.along, out)
    step = _ASIDE * rim.radius[:, None]
    starts = np.concatenate(
        (rim.middles, rim.middles + step * rim.along, rim.middles + step * aside)
    )
    with own_errors() as module:
        way = module.wall_distances(
            np.ascontiguousarray(starts),
            np.ascontiguousarray(np.tile(-out, (3, 1))),
            np.tile(_REACH * rim.radius, 3),
            walls.points,
            walls.triangles,
        )
    met = np.isfinite(way).reshape(3, -1).all(axis=0)
    way = np.where(np.isfinite(way), way, 0.0)
    hits = (starts + way[:, None] * np.tile(out, (3, 1))).reshape(3, -1, 3)
    normals = np.cross(hits[1] - hits[0], hits[2] - hits[0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), np.finfo(float).tiny)[:, None]
    normals[~met | (np.abs(dot(normals, out)) < _LIKE)] = 0.0
    return hits[0], normals


def _nearest_clear(rim: _Rim, clear: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(k,) the nearest clear edge of the same sheet; -1 where there is none."""
    like = np.full(len(clear), -1, np.int64)
    for part in np.unique(rim.part[~clear]):
        mine = rim.part == part
        sites, rows = np.flatnonzero(mine & clear), np.flatnonzero(mine & ~clear)
        if len(sites):
            with own_errors() as module:
                like[rows] = sites[module.nearest(rim.middles[sites], rim.middles[rows])]
    return like
