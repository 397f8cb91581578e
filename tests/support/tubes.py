# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids whose skeleton is known: unions of round-ended tubes round polylines."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from .shapes.base import Array, Rng, Shape, directions, shares


@dataclass(frozen=True, eq=False)
class Tubes(Shape):
    """All points within a radius of polylines: `lines` are (k, 3) arrays, `radii` a number each."""

    lines: tuple[Array, ...]
    radii: tuple[float, ...]

    def distances(self, x: Array) -> Array:
        """(lines, n) from x to each of the lines."""
        return np.array([np.linalg.norm(x - foot(x, line), axis=1) for line in self.lines])

    def field(self, x: Array) -> Array:
        return (self.distances(x) - np.array(self.radii)[:, None]).min(axis=0)

    def normals(self, x: Array) -> Array:
        away = self.distances(x) - np.array(self.radii)[:, None]
        feet = np.array([foot(x, line) for line in self.lines])
        outward = x - feet[away.argmin(axis=0), np.arange(len(x))]
        return outward / np.linalg.norm(outward, axis=1)[:, None]

    @property
    def length(self) -> float:
        return sum(
            float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line in self.lines
        )

    @property
    def _areas(self) -> Array:
        lengths = [np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in self.lines]
        return 2 * np.pi * np.array(self.radii) * np.add(lengths, 2 * np.array(self.radii))

    @cached_property
    def area(self) -> float:
        points = self._thrown(50_000, np.random.default_rng(0))
        return float(self._areas.sum() * (self.field(points) > -1e-9).mean())

    def candidates(self, count: int, rng: Rng) -> Array:
        kept, total = [], 0
        while total < count:
            points = self._thrown(count, rng)
            kept.append(points[self.field(points) > -1e-9])
            total += len(kept[-1])
        return np.concatenate(kept)[:count]

    def _thrown(self, count: int, rng: Rng) -> Array:
        """On all tubes, also where they lie in others."""
        counts = shares(count, self._areas, rng)
        tubes = zip(self.lines, self.radii, counts, strict=True)
        return np.concatenate([_on_tube(line, radius, n, rng) for line, radius, n in tubes])


def _on_tube(line: Array, radius: float, count: int, rng: Rng) -> Array:
    """Area-uniform but for what bends take from it."""
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    along = rng.uniform(-radius, steps.sum() + radius, count)
    marks = np.concatenate(([0.0], np.cumsum(steps)))
    centre = np.column_stack([np.interp(along, marks, line[:, axis]) for axis in range(3)])
    segment = np.clip(np.searchsorted(marks, along) - 1, 0, len(steps) - 1)
    tangent = (np.diff(line, axis=0) / steps[:, None])[segment]
    beyond = along - np.clip(along, 0.0, steps.sum())
    across = directions(count, rng)
    across -= np.einsum("ij,ij->i", across, tangent)[:, None] * tangent
    across /= np.linalg.norm(across, axis=1)[:, None]
    wide = np.sqrt(radius**2 - beyond**2)
    points = centre + beyond[:, None] * tangent + wide[:, None] * across
    away = points - foot(points, line)
    return points - away + radius * away / np.linalg.norm(away, axis=1)[:, None]


def foot(x: Array, line: Array) -> Array:
    """(n, 3) the nearest point of a polyline to each of x."""
    best, nearest = np.full(len(x), np.inf), np.zeros_like(x)
    for a, b in pairwise(line):
        share = np.clip((x - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
        place = a + share[:, None] * (b - a)
        away = np.linalg.norm(x - place, axis=1)
        nearer = away < best
        best[nearer], nearest[nearer] = away[nearer], place[nearer]
    return nearest


# --- the solids


def y_of_tubes() -> Tubes:
    """Three arms in space from the origin; the middle one is thicker."""
    ends = np.array([[0.0, 0.1, -1.2], [0.9, 0.1, 0.8], [-0.8, 0.2, 0.9]])
    return Tubes(tuple(np.array([[0.0, 0.0, 0.0], end]) for end in ends), (0.16, 0.14, 0.12))


def helix() -> Tubes:
    t = np.linspace(0.0, 3 * np.pi, 60)
    return Tubes((np.column_stack((np.cos(t), np.sin(t), 0.14 * t)),), (0.15,))


def trefoil() -> Tubes:
    t = np.linspace(0.0, 2 * np.pi, 80)
    curve = np.stack((np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)))
    return Tubes((0.5 * curve.T,), (0.2,))


def tree(levels: int = 3) -> Tubes:
    """A trunk that forks into two so often; every branch is thinner and shorter than the one it comes from."""
    lines, radii = [], []
    growing = [(np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0]), 1.0, 0.1)]
    for _ in range(levels):
        grown = []
        for start, along, across, length, radius in growing:
            end = start + length * along
            lines.append(np.array([start, end]))
            radii.append(radius)
            other = np.cross(along, across)
            for side in (-1.0, 1.0):
                turned = 0.8 * along + side * 0.6 * across
                grown.append((end, turned, other, 0.75 * length, 0.75 * radius))
        growing = grown
    return Tubes(tuple(lines), tuple(radii))
