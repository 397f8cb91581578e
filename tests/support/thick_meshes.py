# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarse meshes of solids whose thickness is known, and judges of it that are plain loops over points or rays.

Each judge is written from the definition and shares nothing with the add-on.
"""

import numpy as np

from .inputs import of_any_processor
from .meshes import Mesh, icosphere, join, revolved_to_axis

_CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]) - 0.5
_FACES = np.array(
    [
        *((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5)),
        *((0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6)),
        *((0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)),
    ],
    np.int32,
)

TETRAHEDRON = (
    np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], float),
    np.array([(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)], np.int32),
)


def block(x: float, y: float, z: float, centre: tuple = (0.0, 0.0, 0.0)) -> Mesh:
    """A box of eight vertices."""
    return _CORNERS * (x, y, z) + centre, _FACES


def shell(outer: float = 1.0, inner: float = 0.8, subdivisions: int = 4) -> Mesh:
    vertices, triangles = icosphere(subdivisions)
    return join((outer * vertices, triangles), (inner * vertices, triangles[:, ::-1]))


def ellipsoid(axes: tuple = (1.0, 0.7, 0.5), subdivisions: int = 5) -> Mesh:
    vertices, triangles = icosphere(subdivisions)
    return vertices * axes, triangles


def lathe(profile: list[tuple[float, float]], around: int = 96) -> Mesh:
    """Turned about z: the profile is (radius, z) upwards, from the axis to the axis."""
    return revolved_to_axis(profile, around)


def pipe(around: int, low: float, high: float, wall: float, length: float) -> Mesh:
    """A pipe with flat ends, whose outer radius goes from `low` to `high`."""
    angles = 2 * np.pi * np.arange(around) / around
    circle = np.column_stack((np.cos(angles), np.sin(angles), 0 * angles))
    rims = ((low, 0), (high, length), (high - wall, length), (low - wall, 0))
    points = np.concatenate([circle * (r, r, 0) + (0, 0, z) for r, z in rims])
    i, j = np.arange(around), np.roll(np.arange(around), -1)
    pairs = [(k * around, (k + 1) % 4 * around) for k in range(4)]
    faces = [t for a, b in pairs for t in ((a + i, a + j, b + j), (a + i, b + j, b + i))]
    return of_any_processor((points, np.concatenate([np.column_stack(f) for f in faces])))


def shrinking_ball(points: np.ndarray, normals: np.ndarray, surface: np.ndarray) -> tuple:
    """Diameters of the largest balls that are tangent at points from inside and contain nothing of a dense cloud of the
    surface, and (n,) which of it each touches."""
    diameters, touched = np.empty(len(points)), np.empty(len(points), int)
    for i, (p, n) in enumerate(zip(points, normals, strict=True)):
        away = p - surface
        height = away @ n
        square = (away * away).sum(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            balls = np.where(height > 1e-3 * np.sqrt(square), square / height, np.inf)
        touched[i] = balls.argmin()
        diameters[i] = balls[touched[i]]
    return diameters, touched


def rays(points: np.ndarray, normals: np.ndarray, mesh: Mesh) -> np.ndarray:
    """Length of the ray from each point against its normal to the next triangle (Moeller and Trumbore)."""
    vertices, triangles = mesh
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    lengths = np.empty(len(points))
    for i, (p, n) in enumerate(zip(points, normals, strict=True)):
        cross = np.cross(-n, v)
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = 1 / (u * cross).sum(axis=1)
            s = ((p - a) * cross).sum(axis=1) * inverse
            q = np.cross(p - a, u)
            t = (q @ -n) * inverse
            length = (v * q).sum(axis=1) * inverse
            hit = (s >= -1e-9) & (t >= -1e-9) & (s + t <= 1 + 1e-9) & (length > 1e-9)
        lengths[i] = length[hit].min(initial=np.inf)
    return lengths
