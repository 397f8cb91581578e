# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness by the faces of a closed solid: the largest ball that touches each place from inside holds no face.

Nothing is sampled and no axis is computed. The lengths are exact between flat faces, up to their edges.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native
from ..samples.buried_samples import bounding_share
from ..samples.nearness import same_place
from ..samples.outward_faces import are_left_out
from ..samples.sample_spacing import first_pass
from ..samples.sharp_angle import sharp_angle_of
from ..samples.surface_normals import mean_normals
from ..samples.triangles import unit_normals
from ..settings import Between, Edges, Noise, SamplingMode, SidesFrom
from ..small_matrices import dot
from .bounded_lengths import MeasuredSurface
from .fine_faces import FineFaces, coarse_faces, cut_faces

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..machine.progress import Progress
    from ..samples.analysed import Sides
    from ..samples.shape import Shape
    from ..settings import Settings, ThicknessSettings

# Edges between points whose normals differ by 120 degrees or more lead round a wall, and not along it.
_WALL = -0.5  # the cosine of 120 degrees
# The mesh itself shows its thickness where its edges are at most this number of spacings long. If they are longer on
# a larger share of the area, faces are cut until no edge is longer than the other number of spacings.
_COARSE, _SOME, _FINE = 4.0, 0.1, 1.5
_REFLEX, _CONVEX = 1, 2  # kinds of edges
_ASIDE = 1e-3  # rays begin beside the edges of triangles, by this share of the way to the middle
_BURIED = 1e-6  # a larger share of the area that bounds nothing calls for samples


@dataclass(frozen=True, eq=False)
class MeasuredFaces:
    """This says how a shape was measured without samples, in the place of `ChosenSamples`.

    Parameters
    ----------
    reason : str
        A sentence for people.
    sides : Sides
    row : (v,) int64
        The point of the measured surface that each vertex of the shape is.
    gaps : int
    thinned : str
        As of `ChosenSamples`: nothing was thinned.
    """

    reason: str
    sides: Sides
    row: NDArray[np.int64]
    gaps: int = 0
    thinned: str = ""


@dataclass(frozen=True, eq=False)
class _Balls:
    """The balls at the points, then in the middles of triangles all of whose corners lie on edges.

    Parameters
    ----------
    any, wall : (k,) float64
        The diameter of the ball, and the same if it lies between walls; else infinite.
    """

    any: NDArray[np.float64]
    wall: NDArray[np.float64]


def are_enough(shape: Shape, settings: Settings, wanted: ThicknessSettings) -> bool:
    """Whether the faces alone determine the thickness: they are closed, and all of them bound the solid.

    Parameters
    ----------
    shape : Shape
        With faces that look outward.
    settings : Settings
    wanted : ThicknessSettings
    """
    plain = wanted.between is Between.WALL and wanted.noise is Noise.CLEAN
    by_faces = settings.sides in (SidesFrom.AUTOMATIC, SidesFrom.SURFACE)
    if not (plain and by_faces and len(shape.triangles)) or are_left_out(shape).any():
        return False
    if shape.open_edges or not shape.volume > 0.0:
        return False
    return bounding_share(shape, first_pass(shape, settings).spacing) > 1.0 - _BURIED


def lengths_by_faces(
    shape: Shape, settings: Settings, wanted: ThicknessSettings, progress: Progress
) -> tuple[MeasuredSurface, NDArray[np.bool_], NDArray[np.int64], bool]:
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
    with native.own_errors() as module:
        balls_in = module.BallFaces(
            shape.points,
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
    balls = _balls(balls_in, fine, at_edge, bare, progress)
    lengths, measured = _filled(shape, fine, at_edge, bare, balls, wanted.edges)
    count = len(fine.points)
    at_most, in_middles = np.full((2, len(fine.triangles)), np.inf)
    at_most[bare], in_middles[bare] = balls.wall[count:], lengths[count:]
    faces = np.full(len(fine.points), -1, np.int32)
    faces[fine.triangles] = fine.faces[:, None]
    surface = MeasuredSurface(
        points=fine.points,
        triangles=shape.triangles if fine is coarse else fine.triangles,
        lengths=lengths[:count],
        at_edge=on_edge,
        faces=faces,
        at_most=at_most,
        face_of_triangles=fine.faces,
        in_middles=in_middles,
    )
    return surface, measured[:count], row, fine is not coarse


def first_rows(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """(n,) the first row with the coordinates of each."""
    place = same_place(points)
    first = np.empty(place.max(initial=-1) + 1, np.int64)
    first[place[::-1]] = np.arange(len(points))[::-1]
    return first[place]


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


def _ends(fine: FineFaces, kind: int) -> NDArray[np.int32]:
    """(k,) the ends of edges of a kind, some of them several times."""
    rows, sides = np.nonzero(fine.kinds == kind)
    ends = fine.triangles[rows[:, None], np.column_stack((sides, (sides + 1) % 3))]
    return ends.ravel()


def _balls(
    balls_in: Any,
    fine: FineFaces,
    at_edge: NDArray[np.bool_],
    bare: NDArray[np.intp],
    progress: Progress,
) -> _Balls:
    """Measure at each point once, at a point on an edge where the solid is not convex on each of its faces."""
    count, corners = len(fine.points), fine.points[fine.triangles]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean(axis=1)
    point, triangle = fine.triangles.ravel(), np.repeat(np.arange(len(fine.triangles)), 3)
    reflex = np.zeros(count, bool)
    reflex[_ends(fine, _REFLEX)] = True
    once = np.zeros(len(point), bool)
    once[np.unique(point, return_index=True)[1]] = True
    some = np.flatnonzero(~at_edge[point] & (once | reflex[point]))
    places = np.concatenate((fine.points[point[some]], corners[bare].mean(axis=1)))
    rows = np.concatenate((triangle[some], bare))
    with native.own_errors():
        diameters, walls = balls_in.inscribed_balls(
            places, fine.faces[rows], sides[rows], progress=progress.part()
        )
    of_any, of_wall = np.full((2, count + len(bare)), np.inf)
    at = np.concatenate((point[some], count + np.arange(len(bare))))
    np.minimum.at(of_any, at, diameters)
    least = diameters == of_any[at]  # of the faces that meet at the point
    of_wall[at[least]] = walls[least]
    return _Balls(of_any, of_wall)


def _filled(
    shape: Shape,
    fine: FineFaces,
    at_edge: NDArray[np.bool_],
    bare: NDArray[np.intp],
    balls: _Balls,
    edges: Edges,
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """The lengths of points and middles, those of the nearest walls where they have none, and which were measured."""
    count = len(fine.points)
    values = balls.any if edges is Edges.BALL else balls.wall
    measured = np.isfinite(values)
    if edges is Edges.GREY or measured.all():
        return values, measured
    centres = np.repeat(count + np.arange(len(bare)), 3)
    ways = np.column_stack((centres, fine.triangles[bare].ravel()))
    points = np.concatenate((fine.points, fine.points[fine.triangles[bare]].mean(axis=1)))
    normals, _ = mean_normals(fine.points, fine.triangles)
    ends = fine.edges()
    beside = dot(normals[ends[:, 0]], normals[ends[:, 1]]) > _WALL
    left = ~measured[ends].all(axis=1)
    ends = np.concatenate((ends[beside & left], ways)).astype(np.int32)
    edge = np.append(at_edge, np.zeros(len(bare), bool))
    ways = np.concatenate((ends, ends[:, ::-1]))
    to, source = ways.T
    # Where points are farther apart than a plate is thick, its edges have the thickness of the points beside them, and
    # its narrow sides that of the edges.
    start = _of_nearest(values, points, ways[edge[to] & ~edge[source]])
    start = _of_nearest(
        start, points, ways[~edge[to] & edge[source] & (balls.any[to] <= start[source])]
    )
    with native.own_errors() as module:
        filled = module.spread_lengths(start, balls.any, points, ends)
    on_edges = ways[edge[to]]
    while not np.isfinite(filled[edge]).all():
        before, filled = filled, _of_nearest(filled, points, on_edges)
        if np.array_equal(before, filled):
            break
    own = np.where(np.isfinite(balls.any), balls.any, 0.0)
    lengths = np.where(measured, values, np.maximum(filled, own))
    return _below_rays(shape, fine, bare, points, lengths, measured | edge), measured


def _of_nearest(
    values: NDArray[np.float64], points: NDArray[np.float64], ways: NDArray[np.int32]
) -> NDArray[np.float64]:
    """(k,) values; those of points without one are that of the nearest of the points to which ways lead from them."""
    to, source = ways[~np.isfinite(values[ways[:, 0]]) & np.isfinite(values[ways[:, 1]])].T
    away = np.linalg.norm(points[to] - points[source], axis=1)
    order = np.lexsort((values[source], away, to))
    first = order[np.unique(to[order], return_index=True)[1]]
    values = values.copy()
    values[to[first]] = values[source[first]]
    return values


def _below_rays(
    shape: Shape,
    fine: FineFaces,
    bare: NDArray[np.intp],
    points: NDArray[np.float64],
    lengths: NDArray[np.float64],
    known: NDArray[np.bool_],
) -> NDArray[np.float64]:
    """Lower what was filled in, at points and then at middles, to the way straight through the solid."""
    triangle = np.full(len(fine.points), -1)
    triangle[fine.triangles] = np.arange(len(fine.triangles))[:, None]
    triangle = np.concatenate((triangle, bare))
    rows = np.flatnonzero(~known & np.isfinite(lengths) & (lengths > 0.0) & (triangle >= 0))
    if not len(rows):
        return lengths
    corners = fine.points[fine.triangles[triangle[rows]]]
    normals = unit_normals(shape.points[shape.triangles[fine.faces[triangle[rows]]]])[0]
    places = points[rows]
    places = places + _ASIDE * (corners.mean(axis=1) - places)
    with native.own_errors() as module:
        ways = module.wall_distances(places, normals, lengths[rows], shape.points, shape.triangles)
    lengths = lengths.copy()
    lengths[rows] = np.minimum(lengths[rows], ways)
    return lengths
