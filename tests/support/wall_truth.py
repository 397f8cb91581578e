# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of flat faces that are drawn at random, and what their walls are by the definition alone.

A wall lies at a place where the largest ball that touches it from inside also touches a face whose normal differs by
120 degrees or more. Here every ball is compared with every triangle.
"""

from __future__ import annotations

import numpy as np

from .meshes import Mesh
from .thick_meshes import lathe, pipe

_HALVINGS, _TOUCHED = 44, 1e-6


def turned_part(rng: np.random.Generator, finer: int = 1) -> Mesh:
    """A turned part of 12 to 64 sides, or so many times as many, with two to five rings of random radii."""
    around, rings = int(rng.integers(12, 65)), int(rng.integers(2, 6))
    radii, heights = rng.uniform(0.3, 1.0, rings), np.cumsum(rng.uniform(0.15, 0.7, rings))
    outline = [(0.0, heights[0]), *zip(radii, heights, strict=True), (0.0, heights[-1])]
    return lathe(outline, around * finer)


def slanted_plate(rng: np.random.Generator) -> tuple[Mesh, float]:
    """A plate over a rectangle whose rims lean by 60 to 80 degrees from its faces, and its thickness."""
    thickness, size = rng.uniform(0.1, 1.0), rng.uniform(4.0, 12.0, 2)
    lean = thickness / np.tan(np.radians(rng.uniform(60.5, 80.0, 2)))
    corner = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    low = np.column_stack((corner * size / 2, np.zeros(4)))
    high = np.column_stack((corner * (size / 2 - lean), np.full(4, thickness)))
    quads = [(3, 2, 1, 0), (4, 5, 6, 7)] + [
        (i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i) for i in range(4)
    ]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return (np.concatenate((low, high)), np.array(triangles, np.int32)), float(thickness)


def tube(rng: np.random.Generator) -> tuple[Mesh, float]:
    """A pipe with flat ends, and how thick its wall is between opposite flats."""
    around, inner, height = int(rng.integers(12, 49)), rng.uniform(0.5, 0.95), rng.uniform(0.5, 3.0)
    wall = 1.0 - inner
    return pipe(around, 1.0, 1.0, wall, height), wall * np.cos(np.pi / around)


def turned(mesh: Mesh, rng: np.random.Generator, away: float) -> Mesh:
    """The mesh in a random pose, so many of its sizes from the origin."""
    points, triangles = mesh
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    points = points @ turn.T
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    return points + away * size * np.array((0.6, -0.64, 0.48)), triangles


def walls(mesh: Mesh, places: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(k,) the diameters of the largest balls at places on faces, and (k,) whether they lie between walls."""
    points, triangles = mesh
    middle = points.mean(axis=0)
    corners, places = points[triangles] - middle, places - middle
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = across / np.linalg.norm(across, axis=1)[:, None]
    found, between = np.empty(len(places)), np.empty(len(places), bool)
    for i, (place, face) in enumerate(zip(places, faces, strict=True)):
        facing = normals @ normals[face]
        beside = (
            np.abs((corners - place) @ normals[face]).max(axis=1) > 1e-9
        )  # not of its own plane
        low, high = 0.0, float(np.ptp(corners.reshape(-1, 3), axis=0).max())
        for _ in range(_HALVINGS):
            radius = (low + high) / 2
            free = distances(corners[beside], place - radius * normals[face]).min() >= radius
            low, high = (radius, high) if free else (low, radius)
        touched = distances(corners[beside], place - low * normals[face]) <= (1 + _TOUCHED) * low
        found[i], between[i] = 2 * low, (facing[beside][touched] <= -0.5 + 1e-9).any()
    return found, between


def distances(corners: np.ndarray, place: np.ndarray) -> np.ndarray:
    """(m,) how far a place is from triangles."""
    a, b, c = corners.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    height = ((place - a) * normal).sum(axis=1)
    foot = place - height[:, None] * normal
    inside, nearest = np.ones(len(a), bool), np.full(len(a), np.inf)
    for p, q in ((a, b), (b, c), (c, a)):
        way = q - p
        inside &= (np.cross(way, foot - p) * normal).sum(axis=1) >= 0
        share = np.clip(((place - p) * way).sum(axis=1) / (way * way).sum(axis=1), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(place - p - share[:, None] * way, axis=1))
    return np.where(inside, np.abs(height), nearest)
