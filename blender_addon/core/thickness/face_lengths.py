# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness by the faces of a closed solid: the largest ball that touches each place from inside holds no face.

Nothing is sampled and no axis is computed. The lengths are exact between flat faces, up to their edges.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints, Longs
from ..machine import native
from ..machine.progress import Progress
from ..samples.analysed import Sides
from ..samples.buried_samples import bounding_share
from ..samples.sample_spacing import first_pass
from ..settings import Between, Edges, Noise, SamplingMode, Settings, SidesFrom, ThicknessSettings
from ..shape.shape import Shape
from ..shape.solid_faces import sharp_angle_of
from ..shape.triangles import equal_pairs, side_keys, unit_normals
from ..united import united
from .bounded_lengths import MeasuredSurface
from .close_walls import rounding_of
from .fine_faces import FineFaces, coarse_faces, cut_faces

# The mesh itself shows its thickness where its edges are at most this number of spacings long. If they are longer on
# a larger share of the area, faces are cut until no edge is longer than the other number of spacings.
_COARSE, _SOME, _FINE = 4.0, 0.1, 1.5  # chosen: thickness
_REFLEX, _CONVEX = 1, 2  # kinds of edges
_BURIED = 1e-6  # of the area: more that bounds nothing calls for samples; derived: rounding


@dataclass(frozen=True, eq=False)
class MeasuredFaces:
    """This says how a shape was measured without samples, in the place of `ChosenSamples`."""

    reason: str  # A sentence for people
    sides: Sides
    row: Longs  # (v,) The point of the measured surface that each vertex of the shape is
    gaps: int = 0
    thinned: str = ""  # As of `ChosenSamples`: nothing was thinned


@dataclass(frozen=True, eq=False)
class _Balls:
    """The balls at the points, then in the middles of triangles all of whose corners lie on edges."""

    # (k,) The diameter of the ball, the same if it lies between walls, and if these are nearly
    # parallel; else infinite
    any: Floats
    wall: Floats
    parallel: Floats


def are_enough(shape: Shape, settings: Settings, wanted: ThicknessSettings) -> bool:
    """Whether the faces alone determine the thickness: they are closed, and all of them bound the solid.

    The faces look outward.
    """
    plain = wanted.between is Between.WALL and wanted.noise is Noise.CLEAN
    by_faces = settings.sides in (SidesFrom.AUTOMATIC, SidesFrom.SURFACE)
    if not (plain and by_faces and len(shape.triangles)) or shape.left_out.any():
        return False
    if shape.open_edges or not shape.volume > 0.0 or len(shape.crossing):
        return False  # a face that another one crosses may bound the solid in its middle only
    return bounding_share(shape, first_pass(shape, settings).spacing) > 1.0 - _BURIED


def lengths_by_faces(
    shape: Shape, settings: Settings, wanted: ThicknessSettings, progress: Progress
) -> tuple[MeasuredSurface, Flags, Longs, bool]:
    """Measure a shape of which `are_enough` is true.

    Returns
    -------
    surface : MeasuredSurface
        Its points are the vertices, then further points of the faces.
    measured : (n,) bool
        The length was measured at the point itself.
    row : (v,) int64
        The point that each vertex is.
    cut : bool
        The faces were cut.
    """
    row = first_rows(shape.points)
    triangles = np.ascontiguousarray(row[shape.triangles].astype(np.int32))
    # Far from the origin differences lose what sums need not, so the solid comes to the origin.
    middle = (shape.points.min(axis=0) + shape.points.max(axis=0)) / 2.0
    with native.own_errors() as module:
        balls_in = module.BallFaces(
            shape.points - middle,
            triangles,
            sharp_angle=sharp_angle_of(shape, settings),
            sharp_edges=shape.sharp_edges,
            smooth=settings.smooth,
            progress=progress.part(0.3),
        )
        edges, convex, corners = balls_in.creases()
    kinds = np.where(convex, _CONVEX, _REFLEX).astype(np.int8)
    coarse = coarse_faces(shape.points, triangles, edges, kinds)
    longest = longest_piece(shape, settings)
    fine = coarse if math.isinf(longest) else cut_faces(coarse, longest)
    at_edge = np.zeros(len(fine.points), bool)
    at_edge[_ends(fine, _CONVEX)] = True
    at_edge[corners] = True
    on_edge = at_edge.copy()
    on_edge[_ends(fine, _REFLEX)] = True
    bare = np.flatnonzero(on_edge[fine.triangles].all(axis=1))
    places = _Places(shape, balls_in, fine, bare, middle)
    balls = places.balls(at_edge, progress)
    filled = _Filled(places, balls, on_edge, wanted.edges)
    faces = np.full(len(fine.points), -1, np.int32)
    faces[fine.triangles] = fine.faces[:, None]
    count = len(fine.points)
    surface = MeasuredSurface(
        points=fine.points,
        triangles=shape.triangles if fine is coarse else fine.triangles,
        lengths=filled.lengths[:count],
        at_edge=on_edge,
        faces=faces,
        at_most=np.full(len(fine.triangles), np.inf),
        face_of_triangles=fine.faces,
        between_walls=filled.of_triangles,
        between_parallel=filled.parallel,
        at_rest=filled.at_rest,
    )
    return surface, filled.measured[:count], row, fine is not coarse


def first_rows(points: Floats) -> Longs:
    """(n,) the first row with the coordinates of each."""
    places = points + 0.0  # -0.0 is 0.0
    _, first, place = np.unique(places, axis=0, return_index=True, return_inverse=True)
    return first[place.reshape(-1)]


def longest_piece(shape: Shape, settings: Settings) -> float:
    """How long the edges of the pieces are at most into which faces are cut; infinite where none is cut.

    They are cut where they are too coarse to show their thickness at the corners.
    """
    if settings.sampling is SamplingMode.VERTICES:
        return math.inf
    spacing = first_pass(shape, settings).spacing
    if settings.sampling is SamplingMode.AUTOMATIC and shape.of_samples:
        corners = shape.points[shape.triangles]
        longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        areas = unit_normals(corners)[1]
        if areas[longest > _COARSE * spacing].sum() <= _SOME * areas.sum():
            return math.inf
    return _FINE * spacing


def _ends(fine: FineFaces, kind: int) -> Ints:
    """(k,) the ends of edges of a kind, some of them several times."""
    rows, sides = np.nonzero(fine.kinds == kind)
    ends = fine.triangles[rows[:, None], np.column_stack((sides, (sides + 1) % 3))]
    return ends.ravel()


class _Places:
    """Where balls are looked for: the corners of pieces, and the middles of those that have all corners on edges."""

    def __init__(
        self, shape: Shape, balls_in: Any, fine: FineFaces, bare: NDArray[np.intp], middle: Floats
    ) -> None:
        self._balls_in, self._middle, self._rounding = balls_in, middle, rounding_of(shape)
        self.fine, self.bare = fine, bare
        corners = fine.points[fine.triangles]
        self._sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean(axis=1)
        self.points = np.concatenate((fine.points, corners[bare].mean(axis=1)))
        # Each place, some of them several times, with a piece in which it lies.
        self.place = np.append(fine.triangles.ravel(), len(fine.points) + np.arange(len(bare)))
        self.piece = np.append(np.repeat(np.arange(len(fine.triangles)), 3), bare)

    def balls(self, at_edge: Flags, progress: Progress) -> _Balls:
        """Measure at each place once, at one on an edge where the solid is not convex on each of its faces."""
        several = np.zeros(len(self.points), bool)
        several[_ends(self.fine, _REFLEX)] = True
        once = np.zeros(len(self.place), bool)
        once[np.unique(self.place, return_index=True)[1]] = True
        convex = np.append(at_edge, np.zeros(len(self.bare), bool))
        some = np.flatnonzero(~convex[self.place] & (once | several[self.place]))
        at = self.place[some]
        with native.own_errors():
            found = self._balls_in.inscribed_balls(
                *self._given(some), rounding=self._rounding, progress=progress.part()
            )
        of_any, of_wall, of_parallel = np.full((3, len(self.points)), np.inf)
        np.minimum.at(of_any, at, found[0])
        least = found[0] == of_any[at]  # of the faces that meet at the place
        of_wall[at[least]], of_parallel[at[least]] = found[1][least], found[2][least]
        return _Balls(of_any, of_wall, of_parallel)

    def rolled(self, some: NDArray[np.intp]) -> tuple[Floats, Floats]:
        """The balls between walls, and nearly parallel ones, to which those at some of the rows of `place` roll."""
        with native.own_errors():
            walls, parallel = self._balls_in.rolled_balls(
                *self._given(some), rounding=self._rounding
            )
        return walls, parallel

    def _given(self, some: NDArray[np.intp]) -> tuple[NDArray[Any], ...]:
        pieces = self.piece[some]
        points = self.points[self.place[some]] - self._middle
        return points, self.fine.faces[pieces], self._sides[pieces]


class _Filled:
    """The lengths of places, for colours, and those of triangles, for figures.

    The length of a triangle is that of a ball between walls that touches it, and of nothing else. On a sheet where no
    place lies between walls, as on a square pin or the narrow side of a plate, it is the one at which its largest balls
    come to rest when they roll. A body without any walls, as a tetrahedron, is as thick as its largest ball.

    Other places are filled in: they take the nearest length of their sheet, or its largest ball where it has none, and
    no less than their own ball.

    Parameters
    ----------
    lengths : (k,) float64
        Of the places.
    measured : (k,) bool
    of_triangles : (f,) float64
        The least length of each triangle; infinite where there is none.
    parallel : (f,) float64
        The same between walls that are nearly parallel.
    at_rest : (f,) bool
        That ball came to rest against the triangle.
    """

    def __init__(self, places: _Places, balls: _Balls, on_edge: Flags, edges: Edges) -> None:
        self._places = places
        self._on_edge = np.append(on_edge, np.zeros(len(places.bare), bool))
        values = balls.any if edges is Edges.BALL else balls.wall
        self._own = np.where(np.isfinite(balls.any), balls.any, 0.0)
        self.measured = np.isfinite(values)
        self.of_triangles = self._least(values)
        self.parallel = self._least(balls.parallel)
        self.lengths = values
        self.at_rest = np.zeros(len(self.of_triangles), bool)
        if self.measured.all():
            return
        sheet = _joined(places.fine, across=0)
        sources = self._sources(sheet)
        if edges is not Edges.GREY:
            self._fill(sheet, sources)

    def _least(self, values: Floats) -> Floats:
        """(f,) the least of values at the corners and middles of triangles; on an edge they are of other faces, too."""
        place, piece = self._places.place, self._places.piece
        least = np.full(len(self._places.fine.triangles), np.inf)
        inside = ~self._on_edge[place]
        np.minimum.at(least, piece[inside], values[place[inside]])
        return least

    def _sources(self, sheet: Longs) -> Floats:
        """The length that others in a sheet may take from each row of `place`; infinite where there is none."""
        place, piece = self._places.place, self._places.piece
        known = ~self._on_edge[place] & self.measured[place]
        found = np.where(known, self.lengths[place], np.inf)
        start = np.flatnonzero(_without(known, sheet[piece]) & self._are_largest(sheet))
        found[start], parallel = self._places.rolled(start)
        np.minimum.at(self.of_triangles, piece[start], found[start])
        self.at_rest[piece[start]] = True
        np.minimum.at(self.parallel, piece[start], parallel)
        body = _joined(self._places.fine, across=_CONVEX)
        alone = _without(np.isfinite(found), body[piece])
        largest = self._largest(body)
        self.of_triangles[piece[alone]] = largest[alone]
        self.at_rest[piece[alone]] = False
        found[alone] = largest[alone]
        return found

    def _largest(self, group: Longs) -> Floats:
        """The diameter of the largest ball in the group of pieces of each row of `place`."""
        place, piece = self._places.place, self._places.piece
        largest = np.zeros(len(group))
        np.maximum.at(largest, group[piece], self._own[place])
        return largest[group[piece]]

    def _fill(self, sheet: Longs, sources: Floats) -> None:
        rows = np.flatnonzero(~self.measured[self._places.place])
        place = self._places.place[rows]
        nearest, away = self._nearest(sheet, np.flatnonzero(np.isfinite(sources)), rows)
        of_sheet = np.where(np.isfinite(away), sources[nearest], self._largest(sheet)[rows])
        of_sheet = np.maximum(of_sheet, self._own[place])
        order = np.lexsort((of_sheet, away, place))
        first = order[np.unique(place[order], return_index=True)[1]]
        self.lengths = self.lengths.copy()
        self.lengths[place[first]] = of_sheet[first]

    def _are_largest(self, sheet: Longs) -> Flags:
        """Whether no neighbour of a place has a larger ball, by the row of `place`."""
        place, piece = self._places.place, self._places.piece
        own = np.where(self._on_edge, 0.0, self._own)
        of_pieces = np.zeros(len(sheet))
        np.maximum.at(of_pieces, piece, own[place])
        beside = np.zeros(len(own))
        np.maximum.at(beside, place, of_pieces[piece])
        first = np.zeros(len(place), bool)
        first[np.unique(place, return_index=True)[1]] = True
        return np.asarray(first & (own[place] > 0.0) & (own[place] >= beside[place]))

    def _nearest(
        self, sheet: Longs, sources: NDArray[np.intp], rows: NDArray[np.intp]
    ) -> tuple[NDArray[np.intp], Floats]:
        """The source in the same sheet that is nearest to each row of `place`, and how far it is; infinite for none.

        Sheets are laid side by side, so far apart that the nearest source is one of the same sheet.
        """
        places, place = self._places.points, self._places.place
        if not len(sources):
            return np.zeros(len(rows), np.intp), np.full(len(rows), np.inf)
        number = np.unique(sheet, return_inverse=True)[1].ravel()[self._places.piece]
        low = places.min(axis=0)
        apart = 2.0 * float(np.linalg.norm(np.ptp(places, axis=0)[None], axis=1)[0])

        def beside(some: NDArray[np.intp]) -> Floats:
            points = places[place[some]] - low
            points[:, 0] += apart * number[some]
            return points

        with native.own_errors() as module:
            nearest = sources[module.nearest(beside(sources), beside(rows))]
        away = np.linalg.norm(places[place[nearest]] - places[place[rows]], axis=1)
        return nearest, np.where(number[nearest] == number[rows], away, np.inf)


def _without(known: Flags, group: Longs) -> Flags:
    """Whether nothing in the group of each row is known."""
    some = np.zeros(int(group.max(initial=-1)) + 1, bool)
    some[group[known]] = True
    return ~some[group]


def _joined(fine: FineFaces, across: int) -> Longs:
    """(f,) the lowest row of the triangles that are joined to each across edges of kinds up to one."""
    keys = side_keys(fine.triangles, len(fine.points)).ravel()
    open_to = np.flatnonzero((fine.kinds <= across).ravel())
    pairs = open_to[np.column_stack(equal_pairs(keys[open_to]))] // 3
    return united(len(fine.triangles), pairs)
