# SPDX-License-Identifier: GPL-3.0-or-later
"""Axes of balls at the poles: loose (Amenta & Bern; Boissonnat & Cazals), or joined where their power cells meet
(Amenta, Choi & Kolluri)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native
from ..settings import Side
from .medial_axis import MedialAxis, no_edges

if TYPE_CHECKING:
    from numpy.typing import NDArray

_INNER, _OUTER = 1, 2  # values of `_medial.Side`


def pole_axis(analysis: Any, side: Side, progress: Any | None) -> MedialAxis:
    """The poles of a side as vertices, without facets; `progress` is a `_medial.Progress`.

    Raises
    ------
    DegenerateInputError, OutOfMemoryError, Cancelled
    """
    with native.own_errors() as module:
        mesh = analysis.poles(getattr(module.Side, side.name), progress=progress)
    return _axis(
        mesh.vertices, mesh.radius, np.empty((0, 3), np.int32), no_edges(), np.empty(0, np.int32)
    )


def power_shape_axis(analysis: Any, side: Side, progress: Any | None) -> MedialAxis:
    """The power shape of the poles of a side; the poles of the other side take their part of space.

    Parameters
    ----------
    analysis : _medial.MedialAnalysis
        With a bounding sphere, so that every sample has an outer pole.
    side : Side
        BOTH joins all poles of the same side, and none across the surface.
    progress : _medial.Progress or None

    Raises
    ------
    DegenerateInputError, OutOfMemoryError, Cancelled
    """
    with native.own_errors() as module:
        inner, outer = (analysis.poles(s) for s in (module.Side.INNER, module.Side.OUTER))
        centres = np.concatenate((inner.vertices, outer.vertices))
        radii = np.concatenate((inner.radius, outer.radius))
        is_inner = np.arange(len(centres)) < len(inner.vertices)
        shapes = [
            (module.power_shape(centres, radii, wanted, progress=progress), value)
            for of, wanted, value in (
                (Side.INNER, is_inner, _INNER),
                (Side.OUTER, ~is_inner, _OUTER),
            )
            if side in (of, Side.BOTH)
        ]
    balls = np.concatenate([found[0] for found, _ in shapes])
    place = np.full(len(centres), -1, np.int32)
    place[balls] = np.arange(len(balls), dtype=np.int32)
    return _axis(
        centres[balls],
        radii[balls],
        np.concatenate([place[found[1]] for found, _ in shapes]),
        np.concatenate([place[found[2]] for found, _ in shapes]),
        np.concatenate([np.full(len(found[1]), value, np.int32) for found, value in shapes]),
    )


def _axis(
    vertices: NDArray[np.float64],
    radius: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    side: NDArray[np.int32],
) -> MedialAxis:
    """Triangles have no samples of their own, and no theta or rho."""
    count = len(triangles)
    always = np.full(count, np.inf)
    return MedialAxis(
        vertices=vertices,
        radius=radius,
        face_offsets=np.arange(0, 3 * count + 1, 3, dtype=np.int32),
        face_vertices=triangles.reshape(-1),
        theta=always,
        rho=always,
        side=side,
        generators=np.full((count, 2), -1, np.int32),
        unbounded=0,
        zero_area=0,
        edges=edges,
    )
