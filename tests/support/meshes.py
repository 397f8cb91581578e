# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed and open triangle meshes: (vertices (n, 3) float64, triangles (m, 3) int32, outward)."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]


def icosphere(subdivisions: int = 2, radius: float = 1.0, centre: tuple = (0.0, 0.0, 0.0)) -> Mesh:
    phi = (1 + np.sqrt(5)) / 2
    corners = [(-1, phi, 0), (1, phi, 0), (-1, -phi, 0), (1, -phi, 0), (0, -1, phi), (0, 1, phi)]
    corners += [(0, -1, -phi), (0, 1, -phi), (phi, 0, -1), (phi, 0, 1), (-phi, 0, -1), (-phi, 0, 1)]
    faces = "0 11 5  0 5 1  0 1 7  0 7 10  0 10 11  1 5 9  5 11 4  11 10 2  10 7 6  7 1 8 "
    faces += "3 9 4  3 4 2  3 2 6  3 6 8  3 8 9  4 9 5  2 4 11  6 2 10  8 6 7  9 8 1"
    mesh = np.array(corners) / np.hypot(1, phi), np.array(faces.split(), np.int32).reshape(-1, 3)
    for _ in range(subdivisions):
        vertices, triangles = split(mesh)
        mesh = vertices / np.linalg.norm(vertices, axis=1)[:, None], triangles
    return mesh[0] * radius + centre, mesh[1]


def split(mesh: Mesh) -> Mesh:
    """Each triangle into four, at the edge midpoints."""
    vertices, triangles = mesh
    pairs = np.sort(
        np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1
    )
    unique, inverse = np.unique(pairs, axis=0, return_inverse=True)
    ab, bc, ca = (inverse.reshape(3, -1) + len(vertices)).astype(np.int32)
    a, b, c = triangles.T
    quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    midpoints = vertices[unique].mean(axis=1)
    return np.concatenate((vertices, midpoints)), np.concatenate(
        [np.column_stack(q) for q in quarters]
    )


def uv_sphere(segments: int = 32, rings: int = 16, radius: float = 1.0) -> Mesh:
    """Blender's UV sphere: exactly cospherical up to rounding, rows of cocircular points."""
    polar = np.arange(rings + 1) * np.pi / rings
    vertices, triangles = revolved_to_axis([*zip(np.sin(polar), np.cos(polar))], segments)
    return flip((vertices * radius, triangles))


def lattice(ids: NDArray[np.int64]) -> NDArray[np.int32]:
    """(m, 3) two triangles for each square of a lattice of ids, which turn from its rows to its columns."""
    a, b, c, d = ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]
    halves = [np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
    return np.concatenate(halves).astype(np.int32)


def revolved(profile: list[tuple[float, float]], around: int) -> Mesh:
    """A closed profile (rho, z), counter-clockwise where rho is to the right, turned round the z axis."""
    turn = 2 * np.pi * np.arange(around) / around
    rings = [
        np.column_stack((rho * np.cos(turn), rho * np.sin(turn), np.full(around, z)))
        for rho, z in profile
    ]
    ids = np.arange(len(profile) * around).reshape(-1, around)
    return np.concatenate(rings), lattice(np.pad(ids, (0, 1), "wrap").T)


def revolved_to_axis(profile: list[tuple[float, float]], around: int) -> Mesh:
    """A profile (rho, z) from the z axis back to it, upward for an outward surface, turned round that axis."""
    low, high = ((0.0, 0.0, end[1]) for end in (profile[0], profile[-1]))
    vertices = np.vstack([[low], revolved(profile[1:-1], around)[0], [high]])
    ids = np.arange(1, len(vertices) - 1).reshape(-1, around)
    rows = list(zip(ids, np.roll(ids, -1, axis=1)))
    (a, b), (c, d) = rows[0], rows[-1]
    triangles = [np.column_stack((0 * a, b, a))]
    for (a, b), (e, f) in pairwise(rows):
        triangles += [np.column_stack((a, b, f)), np.column_stack((a, f, e))]
    triangles.append(np.column_stack((c, d, np.full(around, len(vertices) - 1))))
    return vertices, np.vstack(triangles).astype(np.int32)


def torus(
    big: float = 1.0, small: float = 0.4, around: int = 48, across: int = 20, turn: float = 0.0
) -> Mesh:
    u, v = np.meshgrid(
        np.arange(around) * 2 * np.pi / around,
        (np.arange(across) + turn) * 2 * np.pi / across,
        indexing="ij",
    )
    ring = big + small * np.cos(v)
    vertices = np.stack((ring * np.cos(u), ring * np.sin(u), small * np.sin(v)), -1).reshape(-1, 3)
    return vertices, lattice(np.pad(np.arange(u.size).reshape(u.shape), (0, 1), "wrap"))


def lathe(profile: NDArray[np.float64], around: int = 64) -> Mesh:
    """A profile (rho, z), upward from the z axis back to it, turned round that axis."""
    turn = np.arange(around) * 2 * np.pi / around
    rho, z = profile[:, :1], np.repeat(profile[:, 1:], around, axis=1)
    rings = np.stack((rho * np.cos(turn), rho * np.sin(turn), z), axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(len(profile) - 1), np.arange(around), indexing="ij")
    a, b = (i * around + j).ravel(), (i * around + (j + 1) % around).ravel()
    quads = (np.column_stack((a, b, b + around)), np.column_stack((a, b + around, a + around)))
    return weld((rings, np.concatenate(quads).astype(np.int32)))


def arc(rows: int) -> NDArray[np.float64]:
    """(2 rows + 2,) angles from -90 to 90 degrees in equal rows; 0 is there twice."""
    quarter = np.linspace(0.0, 0.5 * np.pi, rows + 1)
    return np.concatenate((-quarter[::-1], quarter))


def capsule(start: tuple, end: tuple, radius: float, around: int = 32) -> Mesh:
    """All within that distance of a segment."""
    a, axis = np.asarray(start, float), np.subtract(end, start)
    length = np.linalg.norm(axis)
    turn = arc(around // 4)
    z = radius * np.sin(turn) + length * (np.arange(len(turn)) > around // 4)
    vertices, triangles = lathe(np.column_stack((radius * abs(np.cos(turn)), z)), around)
    across = np.linalg.svd(axis[None])[2][1:]
    frame = np.vstack((across, axis / length))
    frame[0] *= np.sign(np.linalg.det(frame))
    return vertices @ frame + a, triangles


def rectangle(along: int, across: int) -> Mesh:
    """(n, 2) vertices of a grid over |x| <= 1, |y| <= 1 and its triangles, counter-clockwise."""
    x, y = np.meshgrid(np.linspace(-1, 1, along + 1), np.linspace(-1, 1, across + 1), indexing="ij")
    return np.column_stack((x.ravel(), y.ravel())), lattice(np.arange(x.size).reshape(x.shape))


def weld(mesh: Mesh) -> Mesh:
    """Vertices closer than a billionth of the size become one; triangles that lose a corner go."""
    vertices, triangles = mesh
    grid = np.round(vertices / np.ptp(vertices) * 1e9).astype(np.int64)
    _, first, row = np.unique(grid, axis=0, return_index=True, return_inverse=True)
    triangles = row.reshape(-1)[triangles].astype(np.int32)
    whole = np.all(triangles != np.roll(triangles, 1, axis=1), axis=1)
    return vertices[first], np.ascontiguousarray(triangles[whole])


def box(
    counts: tuple[int, int, int] = (8, 6, 4), half: tuple[float, float, float] = (1.0, 0.7, 0.4)
) -> Mesh:
    """A box with a grid of counts edges along x, y, z; (1, 1, 1) is the plain cube of 8 vertices."""
    index: dict[tuple[int, int, int], int] = {}
    triangles = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, counts[axis]):
            for i in range(counts[u]):
                for j in range(counts[v]):
                    quad = [
                        _grid_id(index, axis, end, u, i + x, v, j + y)
                        for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))
                    ]
                    quad = quad if end else quad[::-1]
                    triangles += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    grid = np.array(list(index))
    return (2.0 * grid / counts - 1.0) * half, np.array(triangles, dtype=np.int32)


def _grid_id(index: dict, axis: int, end: int, u: int, i: int, v: int, j: int) -> int:
    key = [0, 0, 0]
    key[axis], key[u], key[v] = end, i, j
    return index.setdefault(tuple(key), len(index))


def join(*meshes: Mesh) -> Mesh:
    """Several meshes as one, without joining vertices."""
    start = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    triangles = [triangles + offset for (_, triangles), offset in zip(meshes, start)]
    return np.concatenate([vertices for vertices, _ in meshes]), np.concatenate(triangles).astype(
        np.int32
    )


def moved(mesh: Mesh, by: tuple = (0.0, 0.0, 0.0), scale: float | tuple = 1.0) -> Mesh:
    """Scaled at the origin, and then moved."""
    return np.asarray(mesh[0], float) * scale + by, mesh[1]


def shape_of(mesh: Mesh, *others: Any) -> Any:
    """The mesh as the add-on takes it, whatever types its numbers have; `others` are the fields behind the faces."""
    from medial_axis.core.shape.shape import Shape

    points, triangles = mesh
    return Shape(
        np.ascontiguousarray(points, float), np.ascontiguousarray(triangles, np.int32), *others
    )


def below(mesh: Mesh, height: float) -> Mesh:
    """The mesh with the faces only whose middle is lower than that; all vertices stay."""
    vertices, triangles = mesh
    return vertices, triangles[vertices[triangles].mean(axis=1)[:, 2] < height]


def flip(mesh: Mesh) -> Mesh:
    return mesh[0], np.ascontiguousarray(mesh[1][:, ::-1])


def jitter(mesh: Mesh, amount: float, seed: int = 0) -> Mesh:
    """General position: every vertex moved by up to `amount` along each axis."""
    vertices, triangles = mesh
    return vertices + np.random.default_rng(seed).uniform(
        -amount, amount, vertices.shape
    ), triangles


def nested_shell(subdivisions: int = 2) -> Mesh:
    """A ball with a round cavity: the inner sphere faces inward."""
    return join(icosphere(subdivisions, 1.0), flip(icosphere(subdivisions, 0.6, (0.1, 0.05, 0.0))))


def hull(points: NDArray[np.float64]) -> NDArray[np.int32]:
    """The triangles of a convex hull, outward."""
    from scipy.spatial import ConvexHull  # which not every Blender has

    found = ConvexHull(points)
    a, b, c = points[found.simplices].transpose(1, 0, 2)
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), found.equations[:, :3]) < 0
    return np.where(inward[:, None], found.simplices[:, ::-1], found.simplices)


def write_off(path: Path, mesh: Mesh) -> str:
    """Writes every coordinate in full, and returns the path as text."""
    vertices, triangles = mesh
    rows = [f"OFF\n{len(vertices)} {len(triangles)} 0"]
    rows += [" ".join(map(repr, row)) for row in vertices.tolist()]
    rows += [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    path.write_text("\n".join(rows) + "\n")
    return str(path)


def write_obj(path: Path, mesh: Mesh) -> str:
    """Writes every coordinate in full, and returns the path as text."""
    rows = [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh[0].tolist()]
    rows += [f"f {a} {b} {c}" for a, b, c in (mesh[1] + 1).tolist()]
    path.write_text("\n".join(rows) + "\n")
    return str(path)


def read(path: Path) -> Mesh:
    """A mesh or a point set (then without triangles) of a file, as the library reads it."""
    from medial_axis.core.files.read_shape import read_shape

    shape, _ = read_shape(path)
    return shape.points, shape.triangles
