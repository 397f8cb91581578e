# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges of a small medial mesh, as segments for capsules."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..machine.native import own_errors
from .reduce import SphereMesh, few_spheres, small_mesh

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..axis.medial_axis import MedialAxis
    from ..machine.progress import Progress


def segments_of(
    axis: MedialAxis, count: int, progress: Progress | None = None
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the edges of a small medial mesh that has at most so many, if its topology allows that.

    The fit of a small mesh moves vertices off the axis where it bends, and even out of the solid where there are few.
    Capsules have less room there, so each vertex becomes the nearest one of the axis.

    Parameters
    ----------
    axis : MedialAxis
        The inner axis.
    count : int
    progress : Progress, optional

    Returns
    -------
    places : (v, 3) float64
        The vertices of the axis.
    segments : (s, 2) int32
        Rows of places, each pair once. A vertex without an edge is a segment between itself and itself.
    """
    wanted = count + 1  # a tree has one vertex more than edges; sheets have fewer
    mesh = small_mesh(axis, wanted, progress)
    segments = _segments(mesh)
    while len(segments) > count and wanted > 1:
        wanted = min(wanted - 1, max(1, wanted * count // len(segments)))
        mesh = few_spheres(mesh, wanted, progress)
        segments = _segments(mesh)
    with own_errors() as module:
        row = module.nearest(axis.vertices, mesh.vertices)
    ends = np.sort(row[segments], axis=1)
    one = segments[:, 0] == segments[:, 1]
    return axis.vertices, np.unique(ends[one | (ends[:, 0] != ends[:, 1])], axis=0)


def _segments(mesh: SphereMesh) -> NDArray[np.int32]:
    """Return all edges, and a pair of equal rows for each vertex without one."""
    sides = mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges = np.unique(np.sort(np.concatenate([sides, mesh.edges]), axis=1), axis=0)
    alone = np.setdiff1d(np.arange(len(mesh.vertices)), edges)
    pairs = np.column_stack([alone, alone])
    return np.ascontiguousarray(np.concatenate([edges, pairs]), np.int32)
