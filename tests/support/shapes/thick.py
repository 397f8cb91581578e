# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball swept along a rectangle, a segment or a curve: the swept set is the axis and the radius is constant."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from support import distance

from .base import Array, Rng, Shape, directions, reject, shares


@dataclass(frozen=True)
class Slab(Shape):
    """The rectangle |x| <= width, |y| <= depth, thickened by a ball of the given radius."""

    width: float = 1.0
    depth: float = 0.7
    radius: float = 0.2
    betti = (1, 0, 0)

    @property
    def _areas(self) -> list[float]:
        flat = 8.0 * self.width * self.depth
        return [
            flat,
            4 * np.pi * self.radius * self.width,
            4 * np.pi * self.radius * self.depth,
            4 * np.pi * self.radius**2,
        ]

    @cached_property
    def area(self) -> float:
        return float(sum(self._areas))

    def candidates(self, count: int, rng: Rng) -> Array:
        flat, along_x, along_y, _ = counts = shares(count, self._areas, rng)
        core = (rng.random((count, 2)) * 2 - 1) * (self.width, self.depth)
        normal = directions(count, rng)
        start = np.cumsum(counts)
        normal[:flat] = [0.0, 0.0, 1.0]
        normal[:flat, 2] = rng.choice([-1.0, 1.0], flat)
        turn = rng.random(count) * 2 * np.pi
        normal[flat : start[1]] = np.column_stack((np.zeros(count), np.cos(turn), np.sin(turn)))[
            :along_x
        ]
        normal[start[1] : start[2]] = np.column_stack(
            (np.cos(turn), np.zeros(count), np.sin(turn))
        )[:along_y]
        core[start[1] :, 0] = self.width * np.sign(normal[start[1] :, 0])
        core[flat : start[1], 1] = self.depth * np.sign(normal[flat : start[1], 1])
        core[start[2] :, 1] = self.depth * np.sign(normal[start[2] :, 1])
        points = np.column_stack((core, np.zeros(count))) + self.radius * normal
        return rng.permutation(points)

    def axis_distance(self, x: Array) -> Array:
        beside = np.maximum(np.abs(x[:, :2]) - (self.width, self.depth), 0.0)
        return np.linalg.norm(np.column_stack((beside, x[:, 2])), axis=1)

    def field(self, x: Array) -> Array:
        return self.axis_distance(x) - self.radius

    def axis_points(self, count: int, seed: int = 0) -> Array:
        rng = np.random.default_rng(seed)
        flat = (rng.random((count, 2)) * 2 - 1) * (self.width, self.depth)
        return np.column_stack((flat, np.zeros(count)))

    def rim_points(self, count: int) -> Array:
        t = (np.arange(count // 4) + 0.5) / (count // 4) * 2 - 1
        x, y = self.width, self.depth
        sides = [(x * t, y + 0 * t), (x * t, -y + 0 * t), (x + 0 * t, y * t), (-x + 0 * t, y * t)]
        return np.concatenate([np.column_stack((u, v, 0 * t)) for u, v in sides])


@dataclass(frozen=True)
class Torus(Shape):
    """Inner axis: the core circle. Outer axis: the z axis, where the ball radius is sqrt(R^2 + z^2) - r."""

    big: float = 1.0
    small: float = 0.4
    betti = (1, 1, 0)

    @cached_property
    def area(self) -> float:
        return 4 * np.pi**2 * self.big * self.small

    def candidates(self, count: int, rng: Rng) -> Array:
        bound = self.big + self.small
        return reject(self._throw, lambda x: np.hypot(x[:, 0], x[:, 1]), bound, count, rng)

    def _throw(self, count: int, rng: Rng) -> Array:
        u, v = rng.random((2, count)) * 2 * np.pi
        ring = self.big + self.small * np.cos(v)
        return np.column_stack((ring * np.cos(u), ring * np.sin(u), self.small * np.sin(v)))

    def axis_distance(self, x: Array) -> Array:
        return np.hypot(np.hypot(x[:, 0], x[:, 1]) - self.big, x[:, 2])

    def outer_axis_distance(self, x: Array) -> Array:
        return np.hypot(x[:, 0], x[:, 1])

    def field(self, x: Array) -> Array:
        return self.axis_distance(x) - self.small

    def axis_points(self, count: int, seed: int = 0) -> Array:
        u = np.random.default_rng(seed).random(count) * 2 * np.pi
        return self.big * np.column_stack((np.cos(u), np.sin(u), np.zeros(count)))


class OnSegment(Shape):
    """The axis is the segment |x| <= length."""

    length: float

    def axis_distance(self, x: Array) -> Array:
        return distance.to_segment(x, np.array([-self.length, 0, 0]), np.array([self.length, 0, 0]))

    def axis_points(self, count: int, seed: int = 0) -> Array:
        points = np.zeros((count, 3))
        points[:, 0] = (np.random.default_rng(seed).random(count) * 2 - 1) * self.length
        points[:2, 0] = (-self.length, self.length)
        return points


@dataclass(frozen=True)
class Capsule(OnSegment):
    """The segment |x| <= length, thickened by a ball."""

    length: float = 1.0
    radius: float = 0.35
    betti = (1, 0, 0)

    @cached_property
    def area(self) -> float:
        return 4 * np.pi * self.radius * (self.length + self.radius)

    def candidates(self, count: int, rng: Rng) -> Array:
        side = int(shares(count, [self.length, self.radius], rng)[0])
        normal = directions(count, rng)
        turn = rng.random(side) * 2 * np.pi
        normal[:side] = np.column_stack((np.zeros(side), np.cos(turn), np.sin(turn)))
        core = self.length * np.sign(normal[:, 0])
        core[:side] = (rng.random(side) * 2 - 1) * self.length
        points = self.radius * normal
        points[:, 0] += core
        return rng.permutation(points)

    def field(self, x: Array) -> Array:
        return self.axis_distance(x) - self.radius


@dataclass(frozen=True)
class Knot(Shape):
    """A tube round the trefoil t -> scale (sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t)."""

    scale: float = 0.5
    radius: float = 0.25
    betti = (1, 1, 0)

    def curve(self, t: Array) -> Array:
        return self.scale * np.stack(
            (np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)), -1
        )

    def tangent(self, t: Array) -> Array:
        return self.scale * np.stack(
            (np.cos(t) + 4 * np.cos(2 * t), -np.sin(t) + 4 * np.sin(2 * t), -3 * np.cos(3 * t)), -1
        )

    def bend(self, t: Array) -> Array:
        return self.scale * np.stack(
            (-np.sin(t) - 8 * np.sin(2 * t), -np.cos(t) + 8 * np.cos(2 * t), 9 * np.sin(3 * t)), -1
        )

    @property
    def length(self) -> float:
        t = np.arange(4000) * 2 * np.pi / 4000
        return float(np.linalg.norm(self.tangent(t), axis=1).mean() * 2 * np.pi)

    @cached_property
    def area(self) -> float:
        return 2 * np.pi * self.radius * self.length

    def candidates(self, count: int, rng: Rng) -> Array:
        kept, total = [], 0
        while total < count:
            t, turn, keep = rng.random((3, count)) * 2 * np.pi
            points, weight = self._tube(t, turn)
            kept.append(points[keep / (2 * np.pi) * 12.0 * self.scale < weight])
            total += len(kept[-1])
        return np.concatenate(kept)[:count]

    def _tube(self, t: Array, turn: Array) -> tuple[Array, Array]:
        """Points of the tube and their area element per radius."""
        first, second = self.tangent(t), self.bend(t)
        speed = np.linalg.norm(first, axis=1)
        binormal = np.cross(first, second)
        curvature = np.linalg.norm(binormal, axis=1) / speed**3
        binormal /= np.linalg.norm(binormal, axis=1)[:, None]
        normal = np.cross(binormal, first / speed[:, None])
        points = self.curve(t) + self.radius * (
            np.cos(turn)[:, None] * normal + np.sin(turn)[:, None] * binormal
        )
        return points, speed * (1.0 - self.radius * curvature * np.cos(turn))

    def axis_distance(self, x: Array) -> Array:
        return distance.to_curve(x, self.curve, self.tangent, 2 * np.pi)

    def field(self, x: Array) -> Array:
        return self.axis_distance(x) - self.radius

    def axis_points(self, count: int, seed: int = 0) -> Array:
        rng = np.random.default_rng(seed)
        t = rng.random(count) * 2 * np.pi
        return self.curve(t)
