# SPDX-License-Identifier: GPL-3.0-or-later
"""Which samples of the faces lie where the surface bounds nothing, because another part of the solid covers it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .shape import Shape


def find_bare(shape: Shape, found: Any, gaps: int, offset: float) -> NDArray[np.bool_]:
    """(n,) True for the samples that lie between inside and outside, False for those that are buried.

    Parameters
    ----------
    shape : Shape
    found : _medial.SurfaceSamples
    gaps : int
        Open edges of the faces. Open faces bound nothing, so none of their samples is buried.
    offset : float
        How far from the surface one looks to both sides.
    """
    # Where the faces point inward the axis is empty, and a warning says why; so no sample is left out there either.
    if gaps or shape.volume < 0:
        return np.ones(len(found.points), bool)
    points, normals = _on_flat_faces(shape, found, 100.0 * offset)
    with native.own_errors() as module:
        return ~module.buried(points, normals, offset, shape.points, shape.triangles)


def _on_flat_faces(
    shape: Shape, found: Any, step: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(n, 3) a place on its flat face for each sample, and (n, 3) the normal of that face.

    Samples may follow the smooth surface, which is not what `_medial.buried` looks at. Places on edges and
    corners are moved towards the middle of the face, by `step` or a tenth of the way: on the edge
    itself the normal of one face may run along the neighbouring face.
    """
    corners = shape.points[shape.triangles[found.triangle]]
    points = np.einsum("ij,ijk->ik", found.barycentric, corners)
    with native.own_errors() as module:
        on_edge = found.kind != int(module.SampleKind.SURFACE)
    inward = corners[on_edge].mean(axis=1) - points[on_edge]
    ways = np.linalg.norm(inward, axis=1)[:, None]
    points[on_edge] += inward * np.minimum(0.1, step / np.where(ways > 0.0, ways, step))
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    return points, normals / np.where(lengths > 0.0, lengths, 1.0)[:, None]
