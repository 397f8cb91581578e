# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls that are closer than the axis shows, as rays from the flat faces find them.

A ball that touches the surface at a place lies inside the solid, so its diameter is at most the way straight through
the solid from there. Where that way is shorter than the measured length, the measurement has missed the opposite wall.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints
from ..machine import native
from ..portable_angle import cosine
from ..samples.chosen import ChosenSamples
from ..samples.walls import Walls
from ..settings import Between
from ..shape.shape import Shape
from ..shape.triangles import equal_pairs, side_keys, unit_normals
from ..small_matrices import dot

# A way through the solid counts where it is shorter than this share of the measured length.
_SHORTER = 0.95  # chosen: unseen
# At an edge whose faces enclose a smaller angle than this the ways through the solid become arbitrarily short, and the
# settings decide what counts.
_ACUTE = math.radians(75.0)  # chosen: unseen
# So many ways through the solid from such an edge, its faces are no longer a wedge but two walls (at 18 degrees).
_REACH = 3.0  # chosen: unseen
_STEPS = 4  # places on an acute edge for each spacing
# Both sides of the faces at the ends of a way are tested this far from them, as a share of the way.
_BESIDE = 0.01  # chosen: unseen


@dataclass(frozen=True, eq=False)
class CloseWalls:
    """Places whose opposite wall the measurement has missed."""

    points: Floats  # (k, 3)
    distance: Floats  # (k,) The way straight through the solid
    share: Floats  # (k,) The share of the surface that each place represents
    faces: Ints  # (k,) The triangle of the shape on which each place lies
    sample: Ints  # (k,) The sample next to each place
    # (v,) The way through the solid at the place of a face that is next to each vertex of the
    # shape, the least of its faces; infinite where none is known
    at_vertices: Floats


def no_close_walls(shape: Shape) -> CloseWalls:
    none, far = np.empty(0, np.int32), np.full(len(shape.points), np.inf)
    return CloseWalls(np.empty((0, 3)), np.empty(0), np.empty(0), none, none, far)


def is_shorter(way: Floats, lengths: Floats) -> Flags:
    """Whether ways through the solid count, compared with the lengths that were measured."""
    return way < _SHORTER * lengths


def close_walls(
    shape: Shape, chosen: ChosenSamples, lengths: Floats, between: Between
) -> CloseWalls:
    """Find the places where the opposite wall is closer than the measured length.

    Parameters
    ----------
    shape : Shape
    chosen : ChosenSamples
    lengths : (n,) float64
        The measured length at each sample; infinite where there is none.
    between : Between
        Gaps are not looked for.
    """
    walls = chosen.samples.walls
    if walls is None or between is not Between.WALL or not len(walls.area):
        return no_close_walls(shape)
    known = _known(shape, walls, overlapping=chosen.samples.buried > 0)
    with native.own_errors() as module:
        sample = module.nearest(chosen.samples.points, walls.points[known])
    closer = is_shorter(walls.distance[known], lengths[sample])
    near, sample = known[closer], sample[closer]
    return CloseWalls(
        points=walls.points[near],
        distance=walls.distance[near],
        share=walls.area[near] / walls.area.sum(),
        faces=walls.faces[near],
        sample=sample,
        at_vertices=_at_vertices(shape, walls, known),
    )


def rounding_of(shape: Shape) -> float:
    """How far a length may be off because coordinates were rounded, and by the arithmetic with them."""
    single = shape.single
    if single is None:  # coordinates that were moved to their own frame were none
        single = not shape.far and np.array_equal(shape.points, shape.points.astype(np.float32))
    unit = 4 * np.finfo(np.float32).eps if single else 16 * np.finfo(np.float64).eps
    return float(unit) * max(shape.far, float(np.abs(shape.points).max(initial=0.0)))


def _known(shape: Shape, walls: Walls, overlapping: bool) -> NDArray[np.intp]:
    """The places whose way through the solid is finite and not in a wedge."""
    finite = np.flatnonzero(np.isfinite(walls.distance))
    if overlapping:
        finite = finite[_are_through(shape, walls, finite)]
    spacing = float(walls.spacing[finite].min(initial=np.inf))
    edge = _distance_to_acute_edges(shape, walls.points[finite], spacing)
    return finite[edge > _REACH * walls.distance[finite] + spacing / _STEPS]


def _are_through(shape: Shape, walls: Walls, rows: NDArray[np.intp]) -> Flags:
    """(k,) whether ways begin and end where the solid does: not at faces of several parts that coincide."""
    places, way = walls.points[rows], walls.distance[rows]
    normals, _ = unit_normals(shape.points[shape.triangles[walls.faces[rows]]])
    beside = _BESIDE * way[:, None] * normals
    through = way > rounding_of(shape)
    with native.own_errors() as module:
        for ends in (places, places - way[:, None] * normals):
            through &= module.buried(ends, beside, 1.0, shape.points, shape.triangles) == 0
    return through


def _at_vertices(shape: Shape, walls: Walls, known: NDArray[np.intp]) -> Floats:
    """As `CloseWalls.at_vertices`."""
    found = np.full(len(shape.points), np.inf)
    way = np.full(len(walls.distance), np.inf)
    way[known] = walls.distance[known]
    used = np.zeros(len(shape.triangles), bool)
    used[walls.faces[known]] = True
    places = np.flatnonzero(used[walls.faces])
    corners = shape.triangles[walls.faces[places]]
    away = np.linalg.norm(shape.points[corners] - walls.points[places, None], axis=2)
    for corner in range(3):
        order = np.lexsort((away[:, corner], walls.faces[places]))
        _, first = np.unique(walls.faces[places[order]], return_index=True)
        nearest = order[first]
        np.minimum.at(found, corners[nearest, corner], way[places[nearest]])
    return found


def _distance_to_acute_edges(shape: Shape, points: Floats, spacing: float) -> Floats:
    """(k,) the distance to the nearest acute convex edge, too large by at most a step; infinite where there is none."""
    ends = _acute_edges(shape)
    if not len(points) or not len(ends):
        return np.full(len(points), np.inf)
    start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    most = max(2, 2_000_000 // len(ends))
    counts = np.ceil(np.linalg.norm(along, axis=1) * _STEPS / spacing)
    counts = np.clip(counts, 1, most).astype(np.int64) + 1
    edge = np.repeat(np.arange(len(ends)), counts)
    step = np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts)
    places = start[edge] + along[edge] * (step / (counts[edge] - 1))[:, None]
    with native.own_errors() as module:
        nearest = module.nearest(places, points)
    return np.linalg.norm(places[nearest] - points, axis=1)


def _acute_edges(shape: Shape) -> Floats:
    """(e, 2, 3) the ends of the edges at which two faces enclose a small angle of the solid."""
    triangles = shape.triangles.astype(np.int64)
    normals, _ = unit_normals(shape.points[triangles])
    corners = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2)
    face = np.repeat(np.arange(len(triangles)), 3)
    first, second = equal_pairs(side_keys(triangles, len(shape.points)).ravel())
    a, b = face[first], face[second]
    ends = shape.points[corners[first]]
    turned = dot(normals[a], normals[b])
    third = shape.points[triangles[b]].sum(axis=1) - shape.points[corners[second]].sum(axis=1)
    convex = dot(normals[a], third - ends[:, 0]) < 0.0
    return ends[convex & (turned < -cosine(_ACUTE))]
