# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets of walls carried on straight: where balls touch reflex edges, to the line where sheets meet, and at rims to
the wall at the end.

The medial axis bulges where walls meet, because the ball there touches the edge between them and no face, and it ends
half a thickness before the wall at a rim. Each vertex there moves by the least way to where the planes of its sheets,
and the walls at its rims, meet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..machine.native import own_errors
from ..shape.triangles import edges_of, unit_normals
from ..small_matrices import dot, shortest_solutions, summed
from .sheet_rims import rims, single_edges
from .sheet_walls import TOUCHES, Walls, between_walls, reflex_distances
from .thin_sheets import ThinSheets
from .unfolded_sheets import unfolded

_LAST = 2  # so many vertices at the end of a bend may be in one of its sheets only
_BENDS = 1e-3  # one less the length of the mean normal of a sheet that is curved, at least; chosen: unseen
_EQUAL = 5e-4  # radii whose quotient differs by less from 1 are equal; chosen: unseen
_FLAT = 2e-8  # one less the cosine between planes that are one; chosen: unseen
_RINGS = 3  # so many rings of facets round a bent one tell nothing either
_UNEVEN = 0.5  # of its thickness: one that is farther from a plane over its sheet is uneven; chosen: unseen
_TIP = 0.5  # of the thickness where a sheet goes on from: at a sharp edge one with less ends in it; chosen: unseen
_INTO = 0.1  # of the way to the middle of its triangles: from there a vertex looks for its walls; chosen: unseen
_PLANE = 0.02  # planes whose directions differ by less do not determine where they meet; chosen: midsurface


@dataclass(frozen=True, eq=False)
class CarriedSheets:
    """Sheets that reach the walls and each other."""

    vertices: Floats  # (v, 3)
    triangles: Ints  # (t, 3)
    part: Ints  # (t,)
    at_corners: Floats  # (t, 3) The thickness of the sheet of each triangle at its corners


def carried(sheets: ThinSheets, walls: Walls) -> CarriedSheets:
    """Carry the sheets on to where they meet and to the walls."""
    away = reflex_distances(sheets.vertices, walls)
    bent = sheets.at_edge | (away <= (1.0 + TOUCHES) * sheets.radius)
    planes = _Planes(sheets, bent, walls)
    rows = _Rows(len(sheets.vertices))
    rows.add(planes.vertex, planes.places, planes.normals)
    rows.add(*planes.at_ends_of_bends(sheets))
    straight = rows.solved(sheets.vertices)
    normals, radii = planes.normals_at_corners(), planes.radii_at_corners(straight)
    ends = rims(sheets, straight, normals, radii, walls)
    rows.add(*ends.planes())
    corners = ends.without_lost_corners(straight, rows.solved(straight), walls)
    vertices = ends.without_ways_back(corners)
    stays = ends.touched(len(vertices))
    vertices = unfolded(vertices, sheets.triangles, normals, stays, rows.within_planes)
    return CarriedSheets(
        vertices, sheets.triangles, sheets.part, 2.0 * planes.radii_at_corners(vertices)
    )


def _clear(sheets: ThinSheets, unclear: Flags) -> Flags:
    """(t,) the triangles whose facets lie between faces as a whole, and are some rings away from others.

    In a sheet that is not so wide they are as many rings away as there are.
    """
    away = np.where(unclear, 0, _RINGS + 1)
    for ring in range(1, _RINGS + 2):
        at = np.zeros(len(sheets.vertices), bool)
        at[sheets.triangles[_in_facets(sheets, unclear)]] = True
        unclear = at[sheets.triangles].any(axis=1)
        away[unclear] = np.minimum(away[unclear], ring - 1)
    away[sheets.sliver] = 0
    most = np.zeros(sheets.parts, np.int64)
    np.maximum.at(most, sheets.part, away)
    return np.asarray((away > 0) & (away == most[sheets.part]))


def _in_facets(sheets: ThinSheets, some: Flags) -> Flags:
    """(t,) the triangles of the facets that have some of the triangles."""
    facets = np.zeros(int(sheets.facet.max()) + 1, bool)
    facets[sheets.facet[some]] = True
    return facets[sheets.facet]


def _tilted(sheets: ThinSheets, unclear: Flags, area: Floats) -> Flags:
    """(t,) the triangles of facets at rims that leave the plane of the facets around.

    A corner of theirs has gone a little way towards the edges of the solid, where the axis forks. Where all facets
    around are at the rim, too, the plane is that of the whole sheet; if the sheet is curved, nothing confirms theirs.
    """
    count = len(sheets.vertices)
    at_rim = np.zeros(count, bool)
    at_rim[single_edges(sheets.triangles)[0]] = True
    rim = _in_facets(sheets, at_rim[sheets.triangles].any(axis=1))
    area = np.where(rim | unclear, 0.0, area)
    total = summed(sheets.triangles, area[:, None], count)
    vectors = area[:, None] * sheets.normals
    sums = summed(sheets.triangles, vectors[:, None], count)
    around, whole = sums[sheets.triangles].sum(axis=1), total[sheets.triangles].sum(axis=1)
    lone = whole == 0.0
    of_parts = _sums_of_parts(vectors, sheets.part, sheets.parts)
    around[lone], whole[lone] = (each[sheets.part[lone]] for each in of_parts)
    length = np.linalg.norm(around, axis=1)
    flat = (whole > 0.0) & (length >= (1.0 - _FLAT) * whole)
    tilted = dot(sheets.normals, around) < (1.0 - _FLAT) * length
    return _in_facets(sheets, rim & (flat & tilted | lone & (length < (1.0 - _BENDS) * whole)))


def are_curved(vectors: Floats, part: Ints, parts: int) -> Flags:
    """(parts,) the sheets without one normal, given (t, 3) normals that are as long as triangles are large."""
    total, whole = _sums_of_parts(vectors, part, parts)
    return np.asarray(np.linalg.norm(total, axis=1) < (1.0 - _BENDS) * whole)


def _sums_of_parts(vectors: Floats, part: Ints, parts: int) -> tuple[Floats, Floats]:
    """(parts, 3) the sums of vectors, and (parts,) those of their lengths."""
    total = summed(part, vectors, parts)
    return total, np.asarray(np.bincount(part, np.linalg.norm(vectors, axis=1), parts), np.float64)


def _are_uneven(sheets: ThinSheets, clear: Flags, area: Floats) -> Flags:
    """(parts,) the sheets over whose clear triangles the thickness does not change evenly."""
    weight = np.where(clear, area, 0.0)
    whole = np.maximum(np.bincount(sheets.part, weight, sheets.parts), np.finfo(float).tiny)
    mean = summed(sheets.part, weight[:, None] * sheets.slopes, sheets.parts) / whole[:, None]
    apart = np.linalg.norm(sheets.slopes - mean[sheets.part], axis=1)
    radius = sheets.radius[sheets.triangles].mean(axis=1)
    change = np.bincount(sheets.part, weight * apart, sheets.parts) * np.sqrt(whole)
    return np.asarray(change > _UNEVEN * np.bincount(sheets.part, weight * radius, sheets.parts))


class _Planes:
    """The plane in which a sheet goes on at each of its vertices, and its thickness there.

    Where the balls touch a reflex edge, and at sharp convex edges, it is that of the nearest vertex of the same sheet
    whose facets are between faces. Where the thickness of the sheet is uneven, rays to its walls correct it.
    """

    def __init__(self, sheets: ThinSheets, bent: Flags, walls: Walls) -> None:
        count = len(sheets.vertices)
        key = sheets.part.astype(np.int64)[:, None] * count + sheets.triangles
        pairs, of_corner = np.unique(key, return_inverse=True)
        self._of_corner = of_corner.reshape(key.shape)
        part, self.vertex = np.divmod(pairs, count)
        area = unit_normals(sheets.vertices[sheets.triangles])[1]
        unclear = bent[sheets.triangles].any(axis=1) | ~sheets.facing
        tilted = _tilted(sheets, unclear, area)
        clear = _clear(sheets, unclear) & ~tilted
        self._take(sheets, part, clear, area)
        vectors = np.where(clear, area, 0.0)[:, None] * sheets.normals
        curved = are_curved(vectors, sheets.part, sheets.parts)
        if curved.any():
            # Far from its facets the plane of a curved sheet is another one. A facet tells its slope
            # as a whole, so one with a corner at an edge, however far that is, tells nothing. Nor
            # does one that looks away from those around it, which is turned over.
            around = summed(sheets.triangles, (area[:, None] * sheets.normals)[:, None], count)
            turned = dot(sheets.normals, around[sheets.triangles].sum(axis=1)) < 0.0
            not_more = unclear | tilted | turned | sheets.sliver | ~self._fits(sheets)
            more = curved[sheets.part] & ~_in_facets(sheets, not_more)
            self._take(sheets, part, clear | more, area)
        known = self.vertex[self._site] == self.vertex
        self._correct(sheets, ~known & _are_uneven(sheets, clear, area)[part], walls)

    def _correct(self, sheets: ThinSheets, asked: Flags, walls: Walls) -> None:
        """Take the middle between the walls at vertices of sheets that go on there from elsewhere."""
        rows = np.flatnonzero(asked)
        if not len(rows):
            return
        places, radius, normals = self.places[rows], self._radius[rows], self.normals[rows]
        vertex, slopes = self.vertex[rows], self._slopes[rows]
        own = sheets.vertices[vertex]
        start = own + _INTO * (self._middles(sheets)[rows] - own)
        told = radius + dot(slopes, start - places)
        found, middles, half = between_walls(start, normals, radius, told, walls)
        self.places[rows[found]], self._radius[rows[found]] = middles[found], half[found]
        at_tip = sheets.at_edge[vertex] & (radius + dot(slopes, own - places) < _TIP * radius)
        self.places[rows[at_tip]] = own[at_tip]
        self._radius[rows[at_tip]] = sheets.radius[vertex[at_tip]]

    def _middles(self, sheets: ThinSheets) -> Floats:
        """(p, 3) the mean of the middles of the triangles around each pair of sheet and vertex."""
        middles = sheets.vertices[sheets.triangles].mean(axis=1)
        sums = summed(self._of_corner, middles[:, None], len(self.vertex))
        return sums / np.bincount(self._of_corner.ravel())[:, None]

    def _take(self, sheets: ThinSheets, part: Longs, clear: Flags, area: Floats) -> None:
        known, normals, slopes = self._means(sheets, np.where(clear, area, 0.0))
        site = self._site = self._sites(sheets.vertices, part, known)
        self.places, self.normals = sheets.vertices[self.vertex[site]], normals[site]
        self._radius, self._slopes = sheets.radius[self.vertex[site]], slopes[site]

    def _fits(self, sheets: ThinSheets) -> Flags:
        """(t,) the triangles whose balls are as large as the planes tell: they are between the same walls.

        A ball that touches an edge is smaller at a rim, and larger where walls meet.
        """
        radii = sheets.radius[sheets.triangles]
        told = self.radii_at_corners(sheets.vertices)
        fits = (np.abs(radii - told) <= _EQUAL * told).all(axis=1)
        return np.asarray(fits)

    def at_ends_of_bends(self, sheets: ThinSheets) -> tuple[Longs, Floats, Floats]:
        """Vertices, and places and normals of planes through them.

        Two sheets that meet at a sharp convex edge may have its last vertices in one of them only. These are in the
        plane of the other sheet, too, as the vertex before them is.
        """
        sides = edges_of(sheets.triangles).astype(np.int64)
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
        near = depth <= (1.0 + TOUCHES) * self._radius[pair]  # on the wall, as at a bend
        return vertex[near], self.places[pair[near]], self.normals[pair[near]]

    def _means(self, sheets: ThinSheets, weight: Floats) -> tuple[Flags, Floats, Floats]:
        """Whether each pair of sheet and vertex has facets between faces, and their mean normal and slope."""
        count, rows = len(self.vertex), self._of_corner.T
        total = summed(rows, weight, count)
        sums = [
            summed(rows, (weight[:, None] * values)[None], count)
            for values in (sheets.normals, sheets.slopes)
        ]
        known = total > 0.0
        length = np.linalg.norm(sums[0], axis=1)
        known &= length > 0.0
        normals = sums[0] / np.where(known, length, 1.0)[:, None]
        return known, normals, sums[1] / np.where(known, total, 1.0)[:, None]

    def _sites(self, vertices: Floats, part: Longs, known: Flags) -> Longs:
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

    def normals_at_corners(self) -> Floats:
        """(t, 3, 3) the normals of the sheets at the corners of the triangles."""
        return self.normals[self._of_corner]

    def radii_at_corners(self, vertices: Floats) -> Floats:
        """(t, 3) half of the thickness of the sheets where they are carried to."""
        away = vertices[self.vertex] - self.places
        radii = np.maximum(self._radius + dot(self._slopes, away), 0.0)
        return radii[self._of_corner]


class _Rows:
    """Planes in which vertices shall lie."""

    def __init__(self, count: int) -> None:
        self._squares = np.zeros((count, 3, 3))
        self._targets = np.zeros((count, 3))
        self._planes = np.zeros(count, np.int64)

    def add(self, vertex: Longs, places: Floats, normals: Floats) -> None:
        count = len(self._planes)
        self._squares += summed(vertex, normals[:, :, None] * normals[:, None, :], count)
        self._targets += summed(vertex, normals * dot(normals, places)[:, None], count)
        self._planes += np.bincount(vertex, minlength=count)

    def solved(self, start: Floats) -> Floats:
        """(v, 3) the places in all planes of each vertex that are nearest to where it is."""
        # The way to the plane, where there is one.
        ways = self._targets - dot(self._squares, start[:, None])
        some = self._planes > 1
        ways[some] = shortest_solutions(self._squares[some], ways[some], _PLANE)
        return start + ways

    def within_planes(self, vertex: Longs, ways: Floats) -> Floats:
        """(k, 3) the parts of ways along which vertices of several planes stay in these; all of the other ways."""
        some = self._planes[vertex] > 1
        squares, ways = self._squares[vertex[some]], ways.copy()
        ways[some] -= shortest_solutions(squares, dot(squares, ways[some][:, None]), _PLANE)
        return ways
