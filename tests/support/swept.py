# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of tubes whose bends and cross-sections are known."""

import numpy as np
from numpy.typing import NDArray

from .meshes import Mesh, lathe


def swept(
    line: NDArray[np.float64],
    first: NDArray[np.float64],
    second: NDArray[np.float64],
    around: int = 32,
) -> Mesh:
    """A tube with flat ends: at each place of the line, an ellipse with two half axes, (n, 3) each."""
    turn = np.arange(around) * 2 * np.pi / around
    rings = (
        line[:, None]
        + np.cos(turn)[:, None] * first[:, None]
        + np.sin(turn)[:, None] * second[:, None]
    )
    points = np.concatenate((rings.reshape(-1, 3), line[[0, -1]]))
    k, after = np.arange(around), (np.arange(around) + 1) % around
    a = around * np.arange(len(line) - 1)[:, None]
    quads = [(a + k, a + after, a + around + after), (a + k, a + around + after, a + around + k)]
    last, middle = around * (len(line) - 1), len(points) - 2
    full = np.full(around, middle)
    caps = [(full, after, k), (full + 1, last + k, last + after)]
    triangles = [
        np.column_stack([np.ravel(corner) for corner in corners]) for corners in (*quads, *caps)
    ]
    return points, np.concatenate(triangles).astype(np.int32)


def capsule(length: float, radius: float, around: int = 32) -> Mesh:
    """Along Z from the origin, with round ends."""
    turn = np.linspace(0, np.pi / 2, around // 4 + 1)
    rho, z = radius * np.sin(turn), radius * np.cos(turn)
    rho[0] = 0.0
    profile = np.column_stack((np.append(rho, rho[::-1]), np.append(-z, length + z[::-1])))
    return lathe(profile, around)


def helix(radius: float, pitch: float, turns: float = 1.5) -> Mesh:
    """A round tube along (cos t, sin t, pitch t)."""
    t = np.linspace(0.0, turns * 2 * np.pi, int(80 * turns))
    line = np.column_stack((np.cos(t), np.sin(t), pitch * t))
    inward = np.column_stack((np.cos(t), np.sin(t), 0 * t))
    upward = np.column_stack((-pitch * np.sin(t), pitch * np.cos(t), -1 + 0 * t))
    upward /= np.sqrt(1 + pitch**2)
    return swept(line, radius * inward, radius * upward)


def elliptic(a: float, b: float, around: int) -> Mesh:
    """A straight tube along Z, three units long."""
    line = np.linspace((0.0, 0.0, -1.5), (0.0, 0.0, 1.5), 40)
    ones = np.ones((40, 1))
    return swept(line, ones * (a, 0.0, 0.0), ones * (0.0, b, 0.0), around)
