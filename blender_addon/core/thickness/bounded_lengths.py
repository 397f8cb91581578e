# SPDX-License-Identifier: GPL-3.0-or-later
"""The measured surface with the walls that only rays find: no length there exceeds the way to the opposite wall.

Lengths at the samples and at the triangles next to such a place are lowered. Where no triangle of the measured surface
is at some of these places on a face, pieces of the face replace the triangles at all of them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints
from ..machine import native
from ..samples.chosen import ChosenSamples
from ..settings import Edges
from ..shape.shape import Shape
from .close_walls import CloseWalls, is_shorter
from .face_pieces import face_pieces


@dataclass(frozen=True, eq=False)
class MeasuredSurface:
    """A surface with lengths: the samples and the triangles between them, then pieces of faces."""

    points: Floats  # (n, 3) The samples, then the corners of the pieces
    triangles: Ints  # (f, 3)
    lengths: Floats  # (n,) Infinite where there is no wall
    at_edge: Flags  # (n,) The point lies on a sharp edge
    # (n,) The face of the shape on which each point lies; -1 where there is none
    faces: Ints | None
    # (f,) The shortest way to an opposite wall that was found at each triangle itself; infinite
    # where there is none
    at_most: Floats
    # (f,) The face of the shape in which each triangle lies; None where they lie in none
    face_of_triangles: Ints | None = None
    # (f,) By the faces, the least ball between walls that touches each triangle, and between walls
    # that are nearly parallel; infinite where there is none
    between_walls: Floats | None = None
    between_parallel: Floats | None = None
    # (f,) By the faces, whether that ball only comes to rest against the triangle, so that no area
    # of it is between walls
    at_rest: Flags | None = None


def bounded(
    shape: Shape, chosen: ChosenSamples, surface: MeasuredSurface, walls: CloseWalls, edges: Edges
) -> MeasuredSurface:
    """Lower the lengths of a surface to the close walls; samples on edges stay grey where the settings say so."""
    if not np.isfinite(walls.at_vertices).any():
        return surface
    at_samples = np.full(len(surface.points), np.inf)
    np.minimum.at(at_samples, walls.sample, walls.distance)
    at_most = at_samples[surface.triangles].min(axis=1, initial=np.inf)
    if surface.triangles is shape.triangles:
        np.minimum.at(at_most, walls.faces, walls.distance)
        closer = is_shorter(walls.at_vertices, surface.lengths)
        at_samples[closer] = np.minimum(at_samples, walls.at_vertices)[closer]
    if edges is not Edges.GREY:
        corners = surface.triangles.ravel()
        some = np.flatnonzero(surface.at_edge[corners])
        np.minimum.at(at_samples, corners[some], at_most[some // 3])
    lengths = np.minimum(surface.lengths, at_samples)
    lowered = replace(surface, lengths=lengths, at_most=at_most)
    return _with_pieces(shape, chosen, lowered, walls)


def _with_pieces(
    shape: Shape, chosen: ChosenSamples, surface: MeasuredSurface, walls: CloseWalls
) -> MeasuredSurface:
    """Replace the close walls on faces where some of them have no triangle by pieces of the faces."""
    used = np.zeros(len(surface.points), bool)
    used[surface.triangles] = True
    torn = np.zeros(len(shape.triangles), bool)
    torn[walls.faces[~used[walls.sample]]] = True
    all_places = chosen.samples.walls
    if all_places is None or not torn.any():
        return surface
    points, triangles, faces = face_pieces(shape, np.flatnonzero(torn), all_places)
    on_torn = np.flatnonzero(torn[walls.faces])
    distance = _of_pieces(points[triangles].mean(axis=1), walls, on_torn, all_places.points)
    near = np.isfinite(distance)
    left = _without(surface, torn)
    return _joined(left, points, triangles[near], faces[near], distance[near])


def _without(surface: MeasuredSurface, torn: Flags) -> MeasuredSurface:
    """Remove the triangles at close walls all of whose corners lie on torn faces; corners on edges lie on any face."""
    if surface.faces is None:
        return surface
    on_torn = (surface.faces >= 0) & torn[surface.faces] | surface.at_edge
    removed = on_torn[surface.triangles].all(axis=1) & np.isfinite(surface.at_most)
    return replace(
        surface, triangles=surface.triangles[~removed], at_most=surface.at_most[~removed]
    )


def _joined(
    surface: MeasuredSurface, points: Floats, triangles: Ints, faces: Ints, distance: Floats
) -> MeasuredSurface:
    """Add triangles, with their faces and lengths, to a surface."""
    names, corners = np.unique(triangles, return_inverse=True)
    corners = corners.reshape(-1, 3)
    lengths, face_of = np.full(len(names), np.inf), np.full(len(names), -1, np.int32)
    np.minimum.at(lengths, corners, distance[:, None])
    face_of[corners] = faces[:, None]
    count = len(surface.points)
    old = np.full(count, -1, np.int32) if surface.faces is None else surface.faces
    return MeasuredSurface(
        points=np.concatenate((surface.points, points[names])),
        triangles=np.concatenate((surface.triangles, (corners + count).astype(np.int32))),
        lengths=np.concatenate((surface.lengths, lengths)),
        at_edge=np.concatenate((surface.at_edge, np.zeros(len(names), bool))),
        faces=np.concatenate((old, face_of)),
        at_most=np.concatenate((surface.at_most, distance)),
    )


def _of_pieces(
    middles: Floats, walls: CloseWalls, some: NDArray[np.intp], places: Floats
) -> Floats:
    """(p,) the distance at the place next to each piece; infinite where that is none of some close walls.

    Each of these walls has at least the piece next to it.
    """
    with native.own_errors() as module:
        row = module.nearest(places, walls.points[some])
        next_place = module.nearest(places, middles)
        next_piece = module.nearest(middles, walls.points[some])
    at_places = np.full(len(places), np.inf)
    np.minimum.at(at_places, row, walls.distance[some])
    distance = at_places[next_place]
    np.minimum.at(distance, next_piece, walls.distance[some])
    return distance
