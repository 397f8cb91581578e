# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples at which the surface bounds nothing, because another part of the solid covers it.

The solid is the region where the winding number of the faces is above one half, whether they are closed or open.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints
from ..machine import native
from ..shape.nearness import near
from ..shape.shape import Shape
from ..shape.triangles import some_of, unit_normals
from ..small_matrices import dot
from .density import REACH

# The distance from the surface at which its two sides are tested, as a share of the spacing.
_OFF = 1e-3  # derived: rounding
# Next to buried parts of the surface, parts of the solid leave clefts. Samples cannot resolve clefts narrower than this
# share of the spacing and would bridge them only in places, so no sample is taken in such clefts.
_CLEFT = 0.25  # chosen: unseen
# Samples in pairs across gaps resolve clefts, too, unless more than this share of them is buried where parts overlap.
_FEW = 0.002  # chosen: unseen
_ON_SIDE = 1e-6  # partners may lie on a side of their triangle, up to this barycentric coordinate; derived: rounding


def find_bare(
    shape: Shape, feet: Floats, normals: Floats, spacing: float, gaps: bool = False
) -> tuple[Flags, int]:
    """Mark the samples that are taken, (n,), and count those left out because the surface bounds nothing there.

    Samples in gaps too narrow for them are not taken either, but do not count.

    The feet and normals are as `on_flat_faces` returns them, the spacing is the distance of neighbours. With `gaps`
    samples are in pairs across gaps, so none is too narrow.
    """
    # Faces that cannot be turned outward, for more edges would be open then, may bound a negative volume: all samples
    # would be left out.
    if shape.volume < 0:
        return np.ones(len(feet), bool), 0
    narrow, found, _ = _are_buried(shape, feet, normals, _OFF * spacing)
    if gaps and np.count_nonzero(found) <= _FEW * len(found):
        return ~found, int(np.count_nonzero(found))
    bare = _outside_clefts(shape, feet, normals, spacing, found)
    count = int(np.count_nonzero(~bare))
    if gaps or np.array_equal(narrow, found):
        return bare, count
    return _outside_clefts(shape, feet, normals, spacing, narrow), count


def _outside_clefts(
    shape: Shape, feet: Floats, normals: Floats, spacing: float, buried: Flags
) -> Flags:
    """Mark the samples that are neither buried nor in clefts next to buried ones, (n,)."""
    with native.own_errors() as module:
        beside = np.flatnonzero(near(feet, feet[buried], REACH * spacing))
        outward = feet[beside] + _CLEFT * spacing * normals[beside]
        above = module.winding_number(outward, shape.points, shape.triangles)
    bare = ~buried
    bare[beside[above > 0.5]] = False
    return bare


def bounding_share(shape: Shape, spacing: float) -> float:
    """Return the share of the area of the faces that bounds the solid.

    The spacing of samples determines how far from the faces their sides are tested.
    """
    areas, buried, _ = sides_of_faces(shape, some_of(len(shape.triangles)), spacing)
    return 1.0 - float(areas[buried].sum() / areas.sum())


def outer_share(shape: Shape, spacing: float) -> float:
    """Return the share of the area that bounds the solid, among the faces that do not lie in it.

    Faces in the solid, as where parts overlap, have the solid at both sides; those of a sheet have nothing at both.

    The spacing is as in `bounding_share`.
    """
    areas, buried, inside = sides_of_faces(shape, some_of(len(shape.triangles)), spacing)
    outer = float(areas[~inside].sum())
    return float(areas[~buried].sum()) / outer if outer > 0.0 else 0.0


def sides_of_faces(
    shape: Shape, rows: NDArray[np.intp], spacing: float
) -> tuple[Floats, Flags, Flags]:
    """Return (k,) twice the areas of some faces, whether they bound nothing, and whether because they lie in the solid.

    `spacing` is as in `bounding_share`.
    """
    corners = shape.points[shape.triangles[rows]]
    normals, areas = unit_normals(corners)
    buried, _, above = _are_buried(shape, corners.mean(axis=1), normals, _OFF * spacing)
    return areas, buried, buried & above


def _are_buried(
    shape: Shape, points: Floats, normals: Floats, off: float
) -> tuple[Flags, Flags, Flags]:
    """(n,) mark the points at which the surface bounds nothing, with those in gaps narrower than `off`, and without.

    The third flags mark which of them have the solid above, at the distance `off` along the normal.
    Both sides are tested at the distance `off`, and closer where that is beyond a thin wall or gap. Walls and gaps no
    thicker than the rounding of their corners are none.
    """
    faces = (shape.points, shape.triangles)
    with native.own_errors() as module:
        narrow = module.buried(points, normals, off, *faces).copy()
        rows = np.flatnonzero(narrow)
        heights = np.array([off, shape.rounding, -shape.rounding])[:, None, None]
        looks = (points[rows] + heights * normals[rows]).reshape(-1, 3)
        far, close, below = module.winding_number(looks, *faces).reshape(3, -1) > 0.5
    found, above = narrow.copy(), np.zeros(len(points), np.bool_)
    narrow[rows], found[rows], above[rows] = far == below, close == below, far
    return narrow, found & narrow, above


def on_flat_faces(shape: Shape, found: Any, faces: Ints, spacing: float) -> tuple[Floats, Floats]:
    """Return (n, 3) a place on its flat face for each sample, and (n, 3) the normal of that face.

    Samples may follow the smooth surface, but `_medial.buried` tests the flat faces. Places on edges and corners are
    moved towards the middle of the face, by a tenth of the spacing or of the distance to the middle: on the edge itself
    the normal of one face may run along the neighbouring face.

    The samples are `_medial.SurfaceSamples`, each on one of (n,) triangles of the shape; the spacing is the distance of
    neighbours.
    """
    corners = shape.points[shape.triangles[faces]]
    points = dot(corners.swapaxes(1, 2), found.barycentric[:, None])
    with native.own_errors() as module:
        on_edge = found.kind != int(module.SampleKind.SURFACE)
    on_edge |= (found.partner >= 0) & (found.barycentric.min(axis=1) < _ON_SIDE)
    inward = corners[on_edge].mean(axis=1) - points[on_edge]
    ways = np.linalg.norm(inward, axis=1)[:, None]
    step = 100.0 * (_OFF * spacing)
    points[on_edge] += inward * np.minimum(0.1, step / np.where(ways > 0.0, ways, step))
    return points, unit_normals(corners)[0]
