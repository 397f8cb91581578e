# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples that close the openings of a surface, where the winding number of its faces is one half."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .analysis import Request


def closed_by_samples(
    request: Request,
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    kinds: NDArray[np.int32],
    radius: NDArray[np.float64],
    progress: Any,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int32]]:
    """Points, normals and kinds of the samples of the faces, and behind them those of the openings.

    Parameters
    ----------
    request : Request
    points, normals : (n, 3) float64
    kinds : (n,) int32
    radius : (n,) float64
        Of the samples' discs.
    progress : _medial.Progress

    Raises
    ------
    InvalidInputError, OutOfMemoryError, Cancelled
    """
    shape = request.shape
    with native.own_errors() as module:
        more, outward, _ = module.closing_samples(
            points,
            normals,
            radius,
            shape.points,
            shape.triangles,
            seed=request.settings.seed,
            progress=progress,
        )
        opening = np.full(len(more), int(module.SampleKind.OPENING), np.int32)
    return (
        np.concatenate((points, more)),
        np.concatenate((normals, outward)),
        np.concatenate((kinds, opening)),
    )
