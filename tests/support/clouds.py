# SPDX-License-Identifier: GPL-3.0-or-later
"""Points on known surfaces, with their normals, and without faces."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def on_ellipsoid(
    count: int = 2000, axes: tuple = (1.0, 0.7, 0.5), seed: int | None = 7
) -> tuple[Array, Array]:
    """(n, 3) points evenly spread as on a spiral, a little shaken by a seed, and (n, 3) unit normals outward."""
    height = 1 - (2 * np.arange(count) + 1) / count
    angle = np.pi * (1 + 5**0.5) * np.arange(count)
    if seed is not None:
        angle += np.random.default_rng(seed).normal(scale=1e-3, size=count)
    level = np.sqrt(1 - height**2)
    sphere = np.column_stack([level * np.cos(angle), level * np.sin(angle), height])
    normals = sphere / axes
    return sphere * axes, normals / np.linalg.norm(normals, axis=1)[:, None]
