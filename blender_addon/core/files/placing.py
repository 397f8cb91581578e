# SPDX-License-Identifier: GPL-3.0-or-later
"""This module splits world transforms that map balls to balls."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..errors import ExportError
from ..small_matrices import stretches


def is_identity(transform: Floats) -> bool:
    """Return whether a transform changes nothing."""
    return np.array_equal(transform[:3], np.eye(3, 4))


def parts_of(transform: Floats) -> tuple[Floats, Floats, float]:
    """Return the linear part of a transform, (3, 3), its offset, (3,), and the factor by which it scales lengths.

    Parameters
    ----------
    transform : (3, 4) or (4, 4) float64
        It may move, turn, mirror and scale evenly.

    Raises
    ------
    ExportError
        It does anything else.
    """
    if transform.shape not in ((3, 4), (4, 4)) or not np.isfinite(transform).all():
        raise ExportError(
            f"Expected a finite 3x4 or 4x4 transform, found shape {transform.shape}; pass a world matrix"
        )
    linear, offset = transform[:3, :3], transform[:3, 3]
    return linear, offset, _even_scale(linear)


def _even_scale(linear: Floats) -> float:
    """Return the factor by which `linear` scales all lengths; it is exactly 1 for a rigid frame in float32."""
    sizes = stretches(linear)[0]
    rounding = (
        16 * np.finfo(np.float32).eps
    )  # world matrices are products of a few float32 matrices
    if sizes[0] == 0.0 or sizes[0] - sizes[2] > rounding * sizes[0]:
        raise ExportError(
            "Expected a medial axis that is scaled evenly, found scales from "
            f"{sizes[2]:.6g} to {sizes[0]:.6g}; scale the source instead and compute its axis again"
        )
    scale = float(sizes.mean())
    return 1.0 if abs(scale - 1.0) <= rounding else scale
