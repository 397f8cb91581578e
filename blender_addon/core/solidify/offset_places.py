# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the vertices of a sheet are on a wall beside it, as far as there is room (docs/solidify.md).

A way is free where a ball round each of its places, which grows to the wall at its end, does not reach the sheet. The
straight way is that of the corner: its end is on the planes of all faces there, moved by the wall. Where another part
of the sheet is nearer than the faces of the vertex, the ball of the medial axis touches both, and the straight way is
not free any more. In a fold the vertex then goes on along the axis, until its ball has the size of the wall; in a gap
the axis leads nowhere, and the vertex stays where the ball is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..shape.triangles import unit_normals
from ..small_matrices import dot, shortest_solutions, summed
from .sheet import beyond_rims, rim_sides

EVEN = 0.005  # what a wall may lack; three times so much where its ways are tight
_FARTHEST = 6.0  # walls from the sheet: the corner of a fold of 19 degrees
_NEAREST = 2.0**-14  # of a way: the first place on it that is looked at
_ROUNDS = 8  # of halving a way, of adding planes, and of smoothing
_SWEEPS = 64  # over planes: in a fold of 20 degrees they leave a thousandth of the way

Distances = Callable[[Floats], Floats]


@dataclass(frozen=True, eq=False)
class OffsetPlaces:
    """Moves of the vertices of a sheet to one of its walls."""

    # (v, 3) No two of these ways cross, but the ends of those that are tight may touch each other
    moves: Floats
    # (v,) The vertices that would not have room at the end of their straight way, and those beside them
    tight: Flags


def offset_places(points: Floats, triangles: Ints, wall: float, progress: Progress) -> OffsetPlaces:
    """Return how the (v, 3) vertices of a sheet move to a wall in front of its (m, 3) triangles.

    These turn counter-clockwise as seen from the side of the wall. A wall of 0 moves nothing.
    """
    if not wall > 0.0:
        return OffsetPlaces(np.zeros_like(points), np.zeros(len(points), bool))
    distances = _distances_from(points, triangles, progress)
    straight = _corner_moves(points, triangles, wall)
    # No way is better than its beginning, between the faces of the vertex alone.
    least = distances(points + _NEAREST * straight) / _NEAREST
    uneven = least < (1.0 - EVEN) * wall
    least = (1.0 - EVEN) * np.minimum(wall, least)
    free, share = _free_shares(points, straight, least, distances)
    rows = np.flatnonzero(free < 1.0)
    for _ in range(_ROUNDS):
        middle = 0.5 * (free[rows] + share[rows])
        away = distances(points[rows] + middle[:, None] * straight[rows])
        more = away >= middle * least[rows]
        free[rows[more]], share[rows[~more]] = middle[more], middle[~more]
    reached = straight * free[:, None]
    rows = np.flatnonzero((free < 1.0) | uneven)
    moves = reached.copy()
    if len(rows):
        endless = _distances_from(*beyond_rims(points, triangles, 2.0 * _FARTHEST * wall), progress)
        moves[rows] += _along_axis(points[rows], straight[rows], reached[rows], wall, endless)
        through = _heights(points, triangles, moves) <= 0.0
        moves[through] = reached[through]
    tight = np.zeros(len(points), bool)
    tight[triangles[(free < 1.0)[triangles].any(axis=1)]] = True
    rim = np.isin(np.arange(len(points)), rim_sides(triangles)[:, 0])
    loose = tight & (~rim | (moves != reached).any(axis=1))
    return OffsetPlaces(_smoothed(points, triangles, wall, moves, loose, distances), tight)


def _smoothed(
    points: Floats, triangles: Ints, wall: float, moves: Floats, loose: Flags, distances: Distances
) -> Floats:
    """(v, 3) the moves, with loose ends nearer to the mean of those round them, where the wall stays as thick.

    In a valley all of them end near one line, on which nothing else keeps them in their order. Rims stay rims.
    """
    if not loose.any():
        return moves
    rims = rim_sides(triangles)[:, :2]
    sides = np.concatenate((triangles[:, :2], triangles[:, 1:], triangles[:, ::2])).astype(np.int64)
    sides = np.concatenate((sides, sides[:, ::-1]))
    inner = ~np.isin(sides[:, 0], rims)
    start, end = np.concatenate((sides[inner], rims, rims[:, ::-1])).T
    count = np.bincount(start, minlength=len(points))[:, None]
    places = points + moves
    least = (1.0 - EVEN) * np.minimum(distances(places), wall)
    lowest = 0.5 * _heights(points, triangles, moves)
    for _ in range(_ROUNDS):
        nearer = 0.5 * places + 0.5 * summed(start, places[end], len(points)) / count
        before = _heights(points, triangles, nearer - points) >= lowest
        fits = loose & before & (distances(nearer) >= least)
        places[fits] = nearer[fits]
    return places - points


def _heights(points: Floats, triangles: Ints, moves: Floats) -> Floats:
    """(v,) how far moves lead in front of the planes of all faces of a vertex, at least."""
    normals, _ = unit_normals(points[triangles])
    found = np.full(len(moves), np.inf)
    for corner in range(3):
        np.minimum.at(found, triangles[:, corner], dot(normals, moves[triangles[:, corner]]))
    return found


def _distances_from(points: Floats, triangles: Ints, progress: Progress) -> Distances:
    with own_errors() as module:
        tree = module.TriangleTree(points, triangles)

    def distances(places: Floats) -> Floats:
        with own_errors():
            return np.asarray(tree.distances(places, progress=progress.part(0.1)))

    return distances


def _corner_moves(points: Floats, triangles: Ints, wall: float) -> Floats:
    """(v, 3) the shortest moves onto the planes of all faces of a vertex, moved by the wall.

    Faces whose normals differ by half a degree or less have no edge between them.
    """
    corners = points[triangles]
    normals, doubled = unit_normals(corners)
    lengths = dot(*[np.roll(corners, -1, axis=1) - corners] * 2)
    # Weights with which the normal is exact where the corners lie on a sphere (Max 1999).
    around = lengths * np.roll(lengths, 1, axis=1)
    weights = doubled[:, None] / np.where(around > 0.0, around, 1.0)
    squares = normals[:, :, None] * normals[:, None, :]
    matrix = summed(triangles.T, weights.T[:, :, None, None] * squares, len(points))
    wanted = summed(triangles.T, weights.T[:, :, None] * normals, len(points))
    moves = wall * shortest_solutions(matrix, wanted, EVEN**2)
    length = np.sqrt(dot(moves, moves))
    return moves * np.minimum(1.0, _FARTHEST * wall / np.maximum(length, wall))[:, None]


def _free_shares(
    points: Floats, moves: Floats, least: Floats, distances: Distances
) -> tuple[Floats, Floats]:
    """(v,) the shares of ways that are free, 1 for whole ways, and the next shares that were looked at.

    The ball at a place covers the way before and behind it, so that the next one is looked at where this ball ends. A
    way along which it grows too slowly is not free from the beginning.
    """
    found, share = np.zeros(len(points)), np.full(len(points), _NEAREST)
    length = np.sqrt(dot(moves, moves))
    rows = np.flatnonzero((length > 0.0) & (length <= 2.0 * _FARTHEST * least))
    while len(rows):
        at = share[rows]
        away = distances(points[rows] + at[:, None] * moves[rows])
        free = away >= at * least[rows]
        found[rows[free]] = at[free]
        more = free & (at < 1.0)
        rows = rows[more]
        share[rows] = np.minimum(1.0, at[more] + away[more] / length[rows])
    return found, share


def _along_axis(
    points: Floats, straight: Floats, reached: Floats, wall: float, distances: Distances
) -> Floats:
    """(k, 3) what vertices move on along the axis from where their straight ways end; 0 where that leads nowhere.

    Where a way is not free, the plane of what is too near there is added to those that its end has to be in front of.
    The sheet of `distances` goes on beyond its rims, so that no way leads round them.
    """
    length = np.sqrt(dot(straight, straight))[:, None]
    normals = (straight / np.where(length > 0.0, length, 1.0))[:, None]
    lacks = np.full((len(points), 1), wall)
    moves, found, rows = straight.copy(), np.zeros_like(straight), np.arange(len(points))
    for _ in range(_ROUNDS):
        least = np.full(len(rows), (1.0 - EVEN) * wall)
        free, share = _free_shares(points[rows], moves[rows], least, distances)
        done = rows[free == 1.0]
        found[done] = moves[done] - reached[done]
        rows, share = rows[free < 1.0], share[free < 1.0]
        if not len(rows):
            break
        place = points[rows] + share[:, None] * moves[rows]
        away, normal = _nearest(place, distances)
        normals = np.concatenate((normals, np.zeros_like(normals[:, :1])), axis=1)
        lacks = np.concatenate((lacks, np.zeros_like(lacks[:, :1])), axis=1)
        normals[rows, -1] = normal
        lacks[rows, -1] = wall - away + share * dot(normal, moves[rows])
        moves[rows] = _least_moves(normals[rows], lacks[rows])
        met = dot(normals[rows], moves[rows, None]) - lacks[rows]
        rows = rows[(met >= -EVEN * wall).all(axis=1)]
    # Ways that are too long end gradually.
    length = np.sqrt(dot(found, found))
    return found * np.clip(2.0 - length / (_FARTHEST * wall), 0.0, 1.0)[:, None]


def _nearest(places: Floats, distances: Distances) -> tuple[Floats, Floats]:
    """(k,) how far places are from the sheet, and (k, 3) the unit vectors along which this grows."""
    away = distances(places)
    gradient = np.zeros_like(places)
    for axis in range(3):
        step = np.zeros_like(places)
        step[:, axis] = EVEN**2 * away
        gradient[:, axis] = distances(places + step) - distances(places - step)
    length = np.sqrt(dot(gradient, gradient))
    return away, gradient / np.where(length > 0.0, length, 1.0)[:, None]


def _least_moves(normals: Floats, lacks: Floats) -> Floats:
    """(k, 3) the least moves that go at least so far along each of (k, n, 3) unit vectors (Hildreth 1957)."""
    moves, weights = np.zeros_like(normals[:, 0]), np.zeros_like(lacks)
    for _ in range(_SWEEPS):
        for row in range(lacks.shape[1]):
            along = normals[:, row]
            weight = np.maximum(weights[:, row] + lacks[:, row] - dot(moves, along), 0.0)
            moves += (weight - weights[:, row])[:, None] * along
            weights[:, row] = weight
    return moves
