# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls that are closer than the axis shows, as rays from the flat faces find them.

A ball that touches the surface at a place lies inside the solid, so its diameter is at most the way straight through
the solid from there. Where that way is shorter than the measured length, the measurement has missed the opposite wall.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..machine import native
from ..samples.triangles import unit_normals
from ..settings import Between

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..samples.chosen import ChosenSamples
    from ..samples.shape import Shape

# A way through the solid counts where it is shorter than this share of the measured length.
_SHORTER = 0.95
# At an edge whose faces enclose a smaller angle than this the ways through the solid become arbitrarily short, and the
# settings decide what counts.
_ACUTE = math.radians(75.0)
# So many ways through the solid from such an edge, its faces are no longer a wedge but two walls (at 18 degrees).
_REACH = 3.0
_STEPS = 4  # places on an acute edge for each spacing


@dataclass(frozen=True, eq=False)
class CloseWalls:
    """Places whose opposite wall the measurement has missed.

    Parameters
    ----------
    points : (k, 3) float64
    distance : (k,) float64
        The way straight through the solid.
    share : (k,) float64
        The share of the surface that each place represents.
    """

    points: NDArray[np.float64]
    distance: NDArray[np.float64]
    share: NDArray[np.float64]


def no_close_walls() -> CloseWalls:
    return CloseWalls(np.empty((0, 3)), np.empty(0), np.empty(0))


def close_walls(
    shape: Shape, chosen: ChosenSamples, lengths: NDArray[np.float64], between: Between
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
    walls = chosen.samples.walls_to_show
    if walls is None or between is not Between.WALL or not len(walls.area):
        return no_close_walls()
    near = np.flatnonzero(np.isfinite(walls.distance))
    with native.own_errors() as module:
        sample = module.nearest(chosen.samples.points, walls.points[near])
    near = near[walls.distance[near] < _SHORTER * lengths[sample]]
    spacing = float(walls.spacing[near].min(initial=np.inf))
    edge = _distance_to_acute_edges(shape, walls.points[near], spacing)
    near = near[edge > _REACH * walls.distance[near] + spacing / _STEPS]
    share = walls.area[near] / walls.area.sum()
    return CloseWalls(walls.points[near], walls.distance[near], share)


def _distance_to_acute_edges(
    shape: Shape, points: NDArray[np.float64], spacing: float
) -> NDArray[np.float64]:
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


def _acute_edges(shape: Shape) -> NDArray[np.float64]:
    """(e, 2, 3) the ends of the edges at which two faces enclose a small angle of the solid."""
    triangles = shape.triangles.astype(np.int64)
    normals, _ = unit_normals(shape.points[triangles])
    corners = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2)
    face = np.repeat(np.arange(len(triangles)), 3)
    keys = corners.min(axis=1) * len(shape.points) + corners.max(axis=1)
    order = np.argsort(keys, kind="stable")
    pairs = order[:-1], order[1:]
    same = keys[pairs[0]] == keys[pairs[1]]
    first, second = pairs[0][same], pairs[1][same]
    a, b = face[first], face[second]
    ends = shape.points[corners[first]]
    turned = np.einsum("ij,ij->i", normals[a], normals[b])
    third = shape.points[triangles[b]].sum(axis=1) - shape.points[corners[second]].sum(axis=1)
    convex = np.einsum("ij,ij->i", normals[a], third - ends[:, 0]) < 0.0
    return ends[convex & (turned < -math.cos(_ACUTE))]
