# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of flat or straight walls whose edges are rounded by rows of faces, and how far points are from them."""

from __future__ import annotations

import numpy as np
from support.meshes import Mesh, arc, lathe, lattice, weld

HEIGHT = 0.3  # of a prism
OUTLINES = {  # of prisms, counter-clockwise; the first corner sees all others
    "triangle": [(0.0, 0.0), (1.0, 0.0), (0.5, 0.8)],
    "hexagon": [(np.cos(a), np.sin(a)) for a in np.arange(6) * np.pi / 3],
    "kite": [(0.0, 0.0), (1.0, -0.35), (1.3, 0.0), (1.0, 0.35)],
    "angle": [(0.3, 0.3), (0.3, 1.0), (0.0, 1.0), (0.0, 0.0), (1.0, 0.0), (1.0, 0.3)],
}


def sides(corners):
    """(k, 2) inward normals of the sides of an outline, and their (k,) distances from the origin."""
    along = np.roll(corners, -1, axis=0) - corners
    inward = np.stack([-along[:, 1], along[:, 0]], axis=1)
    inward /= np.linalg.norm(along, axis=1)[:, None]
    return inward, np.sum(inward * corners, axis=1)


def inner_outline(corners, inset):
    """(k, 2) corners of the outline with all sides moved inward."""
    inward, away = sides(corners)
    pairs = [[k - 1, k] for k in range(len(corners))]
    return np.array([np.linalg.solve(inward[pair], away[pair] + inset) for pair in pairs])


def rounded_prism(corners, radius: float, rows: int) -> Mesh:
    """Its rings from the lower face to the upper one; both of these are fans."""
    turn = np.linspace(0.5 * np.pi, 0.0, rows + 1)
    low = [
        np.column_stack((inner_outline(corners, radius * (1 - c)), np.full(len(corners), z)))
        for c, z in zip(np.cos(turn), radius * (1 - np.sin(turn)), strict=True)
    ]
    rings = [*low, *(ring * (1, 1, -1) + (0, 0, HEIGHT) for ring in low[::-1])]
    ids = np.arange(len(rings) * len(corners)).reshape(len(rings), -1)
    fan = np.column_stack([np.zeros_like(ids[0, 1:-1]), ids[0, 1:-1], ids[0, 2:]])
    faces = [fan[:, ::-1], lattice(np.pad(ids, ((0, 0), (0, 1)), "wrap").T), fan + ids[-1, 0]]
    return np.concatenate(rings), np.concatenate(faces).astype(np.int32)


def off_rounded_prism(points, corners, radius: float):
    """How far points are from the exact surface, whose sections across a side are quarters of a circle."""
    corners = np.asarray(corners)
    inward, away = sides(corners)
    from_sides = points[:, :2] @ inward.T - away
    inset = from_sides.min(axis=1)
    if len(corners) == len(OUTLINES["angle"]) and np.allclose(corners, OUTLINES["angle"]):
        # One of the sides at its hollow corner is enough.
        hollow = np.maximum(from_sides[:, 0], from_sides[:, -1])
        inset = np.minimum(from_sides[:, 1:-1].min(axis=1), hollow)
    below = np.minimum(points[:, 2], HEIGHT - points[:, 2])
    rounded = np.hypot(np.maximum(0, radius - inset), np.maximum(0, radius - below)) - radius
    return np.where(np.minimum(inset, below) < radius, np.abs(rounded), np.minimum(inset, below))


def rounded_box(half, radius: float, rows: int) -> Mesh:
    """A box of three half sides with spheres at its corners, cut along meridians and parallels."""
    up = arc(rows)
    z = np.repeat(np.array([-1.0, 1.0]), rows + 1)
    turn = np.concatenate([arc(rows)[rows + 1 :] + quarter * np.pi / 2 for quarter in range(4)])
    sign = np.repeat([(1, 1), (-1, 1), (-1, -1), (1, -1)], rows + 1, axis=0)
    inner = np.asarray(half, float) - radius
    flat = np.column_stack((np.cos(turn), np.sin(turn)))
    rings = np.empty((len(up), len(turn), 3))
    rings[:, :, :2] = radius * np.cos(up)[:, None, None] * flat + inner[:2] * sign
    rings[:, :, 2] = (radius * np.sin(up) + inner[2] * z)[:, None]
    ids = np.arange(rings[..., 0].size).reshape(len(up), -1)
    cap = ids[-1, :: rows + 1]
    caps = [[cap[0], cap[1], cap[2]], [cap[0], cap[2], cap[3]]]
    low = ids[0, :: rows + 1]
    caps += [[low[0], low[2], low[1]], [low[0], low[3], low[2]]]
    faces = [lattice(np.pad(ids, ((0, 0), (0, 1)), "wrap").T), np.array(caps)]
    return weld((rings.reshape(-1, 3), np.concatenate(faces).astype(np.int32)))


def off_rounded_box(points, half, radius: float):
    beyond = np.abs(points) - (np.asarray(half) - radius)
    outer = np.linalg.norm(np.maximum(beyond, 0), axis=1)
    return np.abs(outer + np.minimum(beyond.max(axis=1), 0) - radius)


def rod(length: float, edge: float, rows: int, around: int) -> Mesh:
    """A cylinder of radius 1 about z whose edges are rounded; with an edge of 1 a capsule."""
    up = arc(rows)
    rho = 1 - edge + edge * np.cos(up)
    z = edge * np.sin(up) + (0.5 * length - edge) * np.repeat([-1.0, 1.0], rows + 1)
    profile = np.column_stack((rho, z))
    ends = [[(0.0, -0.5 * length)], profile, [(0.0, 0.5 * length)]]
    return lathe(np.concatenate(ends), around)


def off_rod(points, length: float, edge: float):
    rho = np.hypot(points[:, 0], points[:, 1])
    beyond = np.column_stack((rho - (1 - edge), np.abs(points[:, 2]) - (0.5 * length - edge)))
    outer = np.linalg.norm(np.maximum(beyond, 0), axis=1)
    return np.abs(outer + np.minimum(beyond.max(axis=1), 0) - edge)
