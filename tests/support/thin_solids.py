# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed solids with thin walls, whose Betti numbers and whose area of the middle sheets are known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import inputs, meshes, resampled
from .plates import prism
from .thick_meshes import lathe

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]
Box = tuple[tuple[float, float, float], tuple[float, float, float]]


@dataclass(frozen=True)
class ThinSolid:
    """A solid, its Betti numbers, and the area of its middle sheets, which end half a wall before its rims.

    `into_edges` is the area of the sheets between those and the edges, where known: of flat walls of one thickness.
    Both are exact for plates, and up to squares of the thickness elsewhere.
    """

    mesh: Mesh
    betti: tuple[int, int, int]
    area: float
    into_edges: float = 0.0


def turned(mesh: Mesh, seed: int = 1) -> Mesh:
    """The mesh in a random pose, rounded to float32 as meshes are stored."""
    return resampled.turned(mesh, inputs.rotation(seed))


def union(*boxes: Box, without: tuple[Box, ...] = ()) -> Mesh:
    """The boundary of a union of boxes, cut along all of their planes so that faces meet edge to edge."""
    every = (*boxes, *without)
    planes = [np.unique([end[axis] for box in every for end in box]) for axis in range(3)]
    middles = [(p[:-1] + p[1:]) / 2 for p in planes]
    grid = np.stack(np.meshgrid(*middles, indexing="ij"), axis=-1)
    filled = np.zeros(grid.shape[:3], bool)
    for at, (low, high) in enumerate(every):
        filled[((grid > low) & (grid < high)).all(axis=-1)] = at < len(boxes)
    padded = np.pad(filled, 1)
    shape = [len(p) for p in planes]
    quads = []
    for axis in range(3):
        for end, step in ((0, -1), (1, 1)):
            outside = np.roll(padded, -step, axis)[1:-1, 1:-1, 1:-1]
            cells = np.argwhere(filled & ~outside)
            u, v = (np.eye(3, dtype=int)[(axis + k) % 3] for k in (1, 2))
            first = cells + end * np.eye(3, dtype=int)[axis]
            ring = [first, first + u, first + u + v, first + v]
            quads.append(np.stack(ring[:: 1 if end else -1], axis=1))
    rows = np.ravel_multi_index(np.moveaxis(np.concatenate(quads), -1, 0), shape)
    used, rows = np.unique(rows, return_inverse=True)
    rows = rows.reshape(-1, 4)
    at = np.unravel_index(used, shape)
    points = np.column_stack([planes[axis][at[axis]] for axis in range(3)])
    triangles = np.concatenate((rows[:, [0, 1, 2]], rows[:, [0, 2, 3]]))
    return points, triangles.astype(np.int32)


def _flat(mesh: Mesh, t: float, area: float) -> ThinSolid:
    """A solid of flat walls.

    From each convex edge a sheet leads to the middle, which lies half of t away from both faces. At convex corners it
    narrows by half of t.
    """
    points, edges = mesh[0], _convex_edges(mesh)
    length = np.linalg.norm(np.subtract(*points[edges].transpose(1, 0, 2)), axis=1).sum()
    corners = (np.bincount(edges.ravel()) == 3).sum()
    return ThinSolid(mesh, (1, 0, 0), area, (length - 3 * corners * t / 4) * t / np.sqrt(2))


def _convex_edges(mesh: Mesh) -> NDArray[np.int32]:
    """(k, 2) the edges where faces meet at less than 180 degrees inside."""
    points, triangles = mesh
    normals = np.cross(*(points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2)))
    sides = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    face = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort(np.sort(sides, axis=1).T)
    one, other = order[::2], order[1::2]
    third = points[triangles[face[other]].sum(axis=1) - sides[other].sum(axis=1)]
    above = np.einsum("ij,ij->i", normals[face[one]], third - points[sides[one, 0]])
    return sides[one[above < -1e-12]]


def plate(t: float) -> ThinSolid:
    return _flat(union(((0, 0, 0), (1, 1, t))), t, (1 - t) ** 2)


def profile_t(t: float) -> ThinSolid:
    mesh = union(((0, 0, 0), (1, 1, t)), ((0.5 - t / 2, 0, t), (0.5 + t / 2, 1, 0.4)))
    return _flat(mesh, t, (1 - t) * (1.4 - 2 * t))


def cross(t: float) -> ThinSolid:
    mesh = union(((0, 0, -t / 2), (1, 1, t / 2)), ((0.5 - t / 2, 0, -0.4), (0.5 + t / 2, 1, 0.4)))
    return _flat(mesh, t, (1 - t) * (1.8 - 2 * t))


def profile_i(t: float) -> ThinSolid:
    flanges = [((0, 0, z), (0.6, 1, z + t)) for z in (0.0, 1.0)]
    mesh = union(*flanges, ((0.3 - t / 2, 0, 0), (0.3 + t / 2, 1, 1 + t)))
    return _flat(mesh, t, (1 - t) * (2.2 - 2 * t))


def profile_l(t: float) -> ThinSolid:
    mesh = union(((0, 0, 0), (1, 1, t)), ((0, 0, 0), (t, 1, 0.5)))
    return _flat(mesh, t, (1 - t) * (1.5 - 2 * t))


def stairs(t: float, steps: int = 3) -> ThinSolid:
    """A bent sheet: treads of 0.4 and risers of 0.3."""
    boxes = []
    for i in range(steps):
        x, z = 0.4 * i, 0.3 * i
        boxes += [
            ((x, 0, z), (x + 0.4 + t, 1, z + t)),
            ((x + 0.4, 0, z), (x + 0.4 + t, 1, z + 0.3 + t)),
        ]
    return _flat(union(*boxes), t, (1 - t) * 0.7 * steps)


def fin(t: float) -> ThinSolid:
    """A cube with a thin fin; the area is that of the fin's sheet alone, so it is a lower bound."""
    mesh = union(((0, 0, 0), (1, 1, 1)), ((0.2, 0.5 - t / 2, 1), (0.8, 0.5 + t / 2, 1.5)))
    return ThinSolid(mesh, (1, 0, 0), 0.0)


def cup(t: float, around: int = 96) -> ThinSolid:
    """An open cylinder of radius 0.5 and height 1 with a bottom."""
    mesh = lathe([(0, 0), (0.5, 0), (0.5, 1), (0.5 - t, 1), (0.5 - t, t), (0, t)], around)
    middle = 0.5 - t / 2
    return ThinSolid(mesh, (1, 0, 0), np.pi * middle**2 + 2 * np.pi * middle * (1 - 1.5 * t))


def tube(t: float, around: int = 96) -> ThinSolid:
    mesh = meshes.revolved([(0.5 - t, 0.0), (0.5, 0.0), (0.5, 1.0), (0.5 - t, 1.0)], around)
    return ThinSolid(mesh, (1, 1, 0), 2 * np.pi * (0.5 - t / 2) * (1 - 2 * t))


def shell(t: float, subdivisions: int = 5) -> ThinSolid:
    points, triangles = meshes.icosphere(subdivisions)
    mesh = meshes.join((points, triangles), ((1 - t) * points, triangles[:, ::-1]))
    return ThinSolid(mesh, (1, 0, 1), 4 * np.pi * (1 - t / 2) ** 2)


def wedge(degrees: float = 2.0) -> ThinSolid:
    angle = np.radians(degrees)
    outline = [(0, 0), (1, 0), (np.cos(angle), np.sin(angle))]
    return ThinSolid(prism(outline, [(0, 1, 2)], 1.0), (1, 0, 0), 1 - 2 * angle)


def slot(gap: float) -> ThinSolid:
    """A block with a narrow slot; the area is a lower bound."""
    low, high = 0.5 - gap / 2, 0.5 + gap / 2
    boxes = ((0, 0, 0), (1, 1, 0.2)), ((0, 0, 0.2), (low, 1, 0.4)), ((high, 0, 0.2), (1, 1, 0.4))
    return ThinSolid(union(*boxes), (1, 0, 0), 0.0)


def layers(gap: float, thickness: float = 0.1) -> ThinSolid:
    """Two plates above each other that one side joins; the area is a lower bound."""
    high = thickness + gap
    plates = [((0, 0, z), (1, 1, z + thickness)) for z in (0.0, high)]
    return ThinSolid(union(*plates, ((0, 0, 0), (0.1, 1, high))), (1, 0, 0), 0.0)


def bent_gap(gap: float) -> ThinSolid:
    """A gap round an edge, between a block and what is joined to it far from there; the area is a lower bound."""
    block = ((0, 0, 0), (0.6, 1, 0.6))
    above = ((0, 0, 0.6 + gap), (0.6 + gap, 1, 1)), ((0.6 + gap, 0, 0), (1, 1, 1))
    return ThinSolid(union(block, *above, ((0, 0, -0.2), (1, 1, 0))), (1, 0, 0), 0.0)


def folded_plate(t: float) -> ThinSolid:
    """A plate whose upper face folds back on itself: three faces lie on each other in its middle."""
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    more = [(0.5, 0), (0.5, 1), (0.5, 0.3), (0.6, 0.5), (0.5, 0.7), (0.4, 0.5)]
    flat = np.concatenate((corners, corners, more))
    points = np.column_stack((flat, np.repeat([0.0, t], [4, len(flat) - 4])))
    # 4 to 7: the corners above; 8, 9: between them; 10 to 13: the fold, whose ends are 10 and 12
    left = [(4, 8, 10), (4, 10, 11), (4, 11, 7), (7, 11, 12), (7, 12, 9)]
    right = [(8, 5, 10), (5, 12, 10), (5, 6, 12), (6, 9, 12), (10, 12, 13)]
    between = [(11, 10, 13), (13, 12, 11)]
    below = [(0, 2, 1), (0, 3, 2)]
    front = [(0, 1, 8), (1, 5, 8), (0, 8, 4)]
    back = [(2, 3, 9), (3, 7, 9), (2, 9, 6)]
    ends = [(3, 0, 4), (3, 4, 7), (1, 2, 6), (1, 6, 5)]
    rows = left + right + between + below + front + back + ends
    return ThinSolid((points, np.array(rows, np.int32)), (1, 0, 0), 1.0)
