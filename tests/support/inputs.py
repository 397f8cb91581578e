# SPDX-License-Identifier: GPL-3.0-or-later
"""Small point sets for the tests: hundreds in general position, and structured ones full of coincidences."""

import numpy as np
from numpy.typing import NDArray

from . import meshes, shapes

Array = NDArray[np.float64]


def of_any_processor(mesh: meshes.Mesh) -> meshes.Mesh:
    """A mesh without the last bits of sines, which differ between processors and decide where samples go."""
    return np.round(mesh[0], 10), mesh[1]


def rotation(seed: int) -> Array:
    """(3, 3) random rotation matrix."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    q[:, 0] *= np.linalg.det(q)
    return q


def turned(points: Array, w: int, x: int, y: int, z: int) -> Array:
    """(n, 3) points turned by the quaternion w + xi + yj + zk, with the same rounding on every machine: products of
    matrices are left to a library that chooses its own order."""
    rows = (
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )
    matrix = np.array(rows) / (w * w + x * x + y * y + z * z)
    return (points[:, None, :] * matrix[None]).sum(axis=2)


def generic(kind: str, n: int, seed: int) -> Array:
    """n points in general position (with probability one)."""
    rng = np.random.default_rng((seed, n))
    if kind == "cube":
        return rng.random((n, 3))
    if kind == "gauss":
        return rng.normal(size=(n, 3)) * (1.0, 3.0, 0.2)
    if kind == "clusters":
        return rng.normal(size=(n, 3)) * 0.02 + rng.random((4, 3))[rng.integers(0, 4, n)]
    if kind == "graded":
        direction = rng.normal(size=(n, 3))
        return (
            direction
            / np.linalg.norm(direction, axis=1)[:, None]
            * 10.0 ** rng.uniform(-3, 0, (n, 1))
        )
    if kind == "sheets":
        return np.column_stack(
            (rng.random((n, 2)), rng.integers(0, 2, n) * 0.3 + rng.normal(size=n) * 1e-3)
        )
    if kind == "helix":
        t = np.sort(rng.random(n)) * 12
        return np.column_stack((np.cos(t), np.sin(t), 0.2 * t)) + rng.normal(size=(n, 3)) * 0.01
    return shapes.SHAPES[kind].random_sample(n, seed) @ rotation(seed).T


def grid(counts: tuple[int, int, int]) -> Array:
    return np.stack(np.meshgrid(*(np.arange(float(c)) for c in counts), indexing="ij"), -1).reshape(
        -1, 3
    )


def hollow(counts: tuple[int, int, int]) -> Array:
    """Surface points of a grid."""
    points = grid(counts)
    return points[np.any((points == 0) | (points == np.array(counts) - 1), axis=1)]


def prism(sides: int, layers: int) -> Array:
    """Regular polygons above each other: cocircular, and cospherical in pairs of layers up to rounding."""
    turn = np.arange(sides) * 2 * np.pi / sides
    ring = np.column_stack((np.cos(turn), np.sin(turn)))
    return np.concatenate(
        [np.column_stack((ring, np.full(sides, 0.3 * layer))) for layer in range(layers)]
    )


def structured_cases() -> dict[str, Array]:
    """Coincidences of every kind: exact ones, and the same turned so that rounding breaks them."""
    exact = {
        "cube corners": grid((2, 2, 2)),
        "grid 3x3x3": grid((3, 3, 3)),
        "grid 4x3x2": grid((4, 3, 2)),
        "hollow 4x4x4": hollow((4, 4, 4)),
        "hollow 6x5x4": hollow((6, 5, 4)),
        "flat grid 6x5x2": grid((6, 5, 2)),
        "octahedron": np.concatenate((np.eye(3), -np.eye(3))),
        "cross": np.concatenate((np.eye(3), -np.eye(3), 2 * np.eye(3), -2 * np.eye(3))),
        "icosahedron": meshes.icosphere(0)[0],
        "icosphere": meshes.icosphere(2)[0],
        "uv sphere": meshes.uv_sphere(12, 8)[0],
        "uv sphere float32": meshes.uv_sphere(16, 10)[0].astype(np.float32).astype(float),
        "torus grid": meshes.torus(around=18, across=10)[0],
        "prism": prism(12, 6),
        "box mesh": meshes.box((6, 4, 3))[0],
        "bipyramid": np.concatenate((prism(16, 1), [[0, 0, 1.0], [0, 0, -1.0]])),
    }
    turned = {f"{name} turned": points @ rotation(7).T for name, points in exact.items()}
    single = {
        f"{name} turned float32": (points @ rotation(3).T).astype(np.float32).astype(float)
        for name, points in exact.items()
    }
    return exact | turned | single
