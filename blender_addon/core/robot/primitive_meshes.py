# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of a robot: those of files, and boxes, cylinders, balls and capsules, whose meshes hold the solid."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..files.read_shape import read_shape
from ..machine.memory_limit import MemoryLimit
from ..portable_angle import cosine
from ..shape.triangles import unit_normals
from ..small_matrices import dot

Mesh = tuple[Floats, Ints]

_AROUND = 48  # sides of a cylinder, which is 0.2 % wider than the round one
_RINGS = 25  # of a ball; none lies on its equator, where a capsule has a wall


def box_mesh(size: Floats) -> Mesh:
    """Return a box round the origin; `size` is (3,)."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], np.float64)
    quads = np.array(
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    )
    return corners * size / 2, _triangles(quads)


def cylinder_mesh(radius: float, length: float) -> Mesh:
    """Return a cylinder along Z round the origin, whose sides touch the round one."""
    wide = radius / cosine(math.pi / _AROUND)
    return _turned([(0.0, -length / 2), (wide, -length / 2), (wide, length / 2), (0.0, length / 2)])


def ball_mesh(radius: float, half: float = 0.0) -> Mesh:
    """Return a ball round the origin, or a capsule along Z, twice `half` longer; nearest faces touch the round one."""
    angles = [math.pi * k / _RINGS for k in range(_RINGS + 1)]
    points, triangles = _turned([(cosine(x - math.pi / 2), -cosine(x)) for x in angles])
    distance = dot(unit_normals(points[triangles])[0], points[triangles[:, 0]])
    points = points * (radius / float(distance.min()))
    return points + [0, 0, half] * np.sign(points), triangles


def _turned(profile: list[tuple[float, float]]) -> Mesh:
    """Return the surface that a profile of (radius, height) makes, whose first and last place lie on the axis."""
    turn = np.array([2.0 * math.pi * k / _AROUND for k in range(_AROUND)])
    circle = np.column_stack([cosine(turn), cosine(turn - math.pi / 2)])
    rings = [np.column_stack([r * circle, np.full(_AROUND, z)]) for r, z in profile[1:-1]]
    ends = [[0.0, 0.0, profile[0][1]], [0.0, 0.0, profile[-1][1]]]
    points = np.concatenate([*rings, ends])
    k = np.arange(_AROUND)
    after, low, high = (k + 1) % _AROUND, len(points) - 2, len(points) - 1
    last = (len(rings) - 1) * _AROUND
    caps = [
        np.column_stack([np.full(_AROUND, low), after, k]),
        np.column_stack([np.full(_AROUND, high), last + k, last + after]),
    ]
    quads = [
        np.column_stack([k, after, after + _AROUND, k + _AROUND]) + ring * _AROUND
        for ring in range(len(rings) - 1)
    ]
    return points, np.concatenate([*caps, *map(_triangles, quads)]).astype(np.int32)


def _triangles(quads: Longs) -> Ints:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.int32)


def mesh_of_file(
    path: Path,
    scale: Floats,
    limit: MemoryLimit | None,
    moved: Callable[[Floats], Floats] = lambda points: points,
) -> Mesh:
    """Return the mesh of a file, moved and then scaled along the axes; a mirrored one keeps its faces outward."""
    found, _ = read_shape(path, limit)
    triangles = found.triangles if scale.prod() > 0.0 else found.triangles[:, ::-1]
    return moved(found.points) * scale, np.ascontiguousarray(triangles)
