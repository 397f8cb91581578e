# SPDX-License-Identifier: GPL-3.0-or-later
"""Which samples of the faces lie where the surface bounds nothing, because another part of the solid covers it.

The solid is where the winding number of the faces is above one half, be they closed or open.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native
from .nearness import near
from .triangles import some_of, unit_normals

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .shape import Shape

# How far from the surface one looks for its two sides, as a share of the spacing.
_OFF = 1e-3
# Beside what is buried, parts of the solid leave clefts. Those narrower than this share of the spacing, which the
# samples cannot tell from one solid, would be bridged here and there only: no sample is taken in them.
_CLEFT = 0.25
_ROUNDINGS = 4  # of float32, in which meshes are stored: a wall that is less thick is a sheet
_BESIDE = 1.5  # how far from buried samples clefts are looked for, in spacings


def find_bare(
    shape: Shape,
    feet: NDArray[np.float64],
    normals: NDArray[np.float64],
    spacing: float,
) -> NDArray[np.bool_]:
    """(n,) True for the samples that lie between inside and outside, False for those that are buried.

    Parameters
    ----------
    shape : Shape
    feet, normals : (n, 3) float64
        As from `on_flat_faces`.
    spacing : float
        The distance of neighbours.
    """
    # Where the faces point inward the axis is empty, and a warning says why; so no sample is left out there either.
    if shape.volume < 0:
        return np.ones(len(feet), bool)
    found = _are_buried(shape, feet, normals, _OFF * spacing)
    with native.own_errors() as module:
        beside = np.flatnonzero(near(feet, feet[found], _BESIDE * spacing))
        outward = feet[beside] + _CLEFT * spacing * normals[beside]
        above = module.winding_number(outward, shape.points, shape.triangles)
    bare = ~found
    bare[beside[above > 0.5]] = False
    return bare


def bounding_share(shape: Shape, spacing: float) -> float:
    """The share of the area of the faces that bounds the solid.

    Parameters
    ----------
    shape : Shape
    spacing : float
        One looks as far from the faces as for samples so far apart.
    """
    corners = shape.points[shape.triangles[some_of(len(shape.triangles))]]
    normals, areas = unit_normals(corners)
    buried = _are_buried(shape, corners.mean(axis=1), normals, _OFF * spacing)
    return 1.0 - float(areas[buried].sum() / areas.sum())


def _are_buried(
    shape: Shape, points: NDArray[np.float64], normals: NDArray[np.float64], off: float
) -> NDArray[np.bool_]:
    """(n,) True where the surface bounds nothing.

    One looks `off` beyond it; through a wall that is thinner than this, half as far as that is thick. A wall is no
    thicker than the rounding of its corners to float32 where it is a sheet without thickness.
    """
    faces = (shape.points, shape.triangles)
    rounding = _ROUNDINGS * float(np.finfo(np.float32).eps) * float(np.abs(shape.points).max())
    with native.own_errors() as module:
        found = module.buried(points, normals, off, *faces).copy()
        rows = np.flatnonzero(found)
        reach = np.full(len(rows), 2.0 * off)
        thick = module.wall_distances(points[rows], normals[rows], reach, *faces)
        thin = np.isfinite(thick) & (thick > rounding)
        rows, half = rows[thin], thick[thin, None] / 2.0
        found[rows] = module.buried(points[rows], half * normals[rows], 1.0, *faces)
    return found


def on_flat_faces(
    shape: Shape, found: Any, spacing: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(n, 3) a place on its flat face for each sample, and (n, 3) the normal of that face.

    Samples may follow the smooth surface, which is not what `_medial.buried` looks at. Places on edges and
    corners are moved towards the middle of the face, by a tenth of the spacing or of the way: on the edge
    itself the normal of one face may run along the neighbouring face.

    Parameters
    ----------
    shape : Shape
    found : _medial.SurfaceSamples
    spacing : float
        The distance of neighbours.
    """
    corners = shape.points[shape.triangles[found.triangle]]
    points = np.einsum("ij,ijk->ik", found.barycentric, corners)
    with native.own_errors() as module:
        on_edge = found.kind != int(module.SampleKind.SURFACE)
    inward = corners[on_edge].mean(axis=1) - points[on_edge]
    ways = np.linalg.norm(inward, axis=1)[:, None]
    step = 100.0 * (_OFF * spacing)
    points[on_edge] += inward * np.minimum(0.1, step / np.where(ways > 0.0, ways, step))
    return points, unit_normals(corners)[0]
