# SPDX-License-Identifier: GPL-3.0-or-later
"""Ellipsoids, whose axes are elliptical discs or segments, and shells, whose axes are the middle surfaces."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from support import distance

from .base import Array, Rng, Shape, directions, reject, shares


def _over_sphere(function: Callable[[Array], Array]) -> float:
    """Integral of a function of directions over the unit sphere."""
    z, weight = np.polynomial.legendre.leggauss(200)
    turn = (np.arange(400) + 0.5) * np.pi / 200.0
    ring = np.sqrt(1.0 - z**2)[:, None]
    grid = np.broadcast_arrays(ring * np.cos(turn), ring * np.sin(turn), z[:, None])
    values = function(np.stack(grid, -1).reshape(-1, 3)).reshape(200, 400)
    return float((values.mean(axis=1) * weight).sum() * 2 * np.pi)


@dataclass(frozen=True)
class Ellipsoid(Shape):
    """Semi-axes a >= b >= c, c the strictly shortest."""

    a: float = 1.0
    b: float = 0.75
    c: float = 0.4
    betti = (1, 0, 0)

    @property
    def semi_axes(self) -> Array:
        return np.array([self.a, self.b, self.c])

    def _stretch(self, direction: Array) -> Array:
        """Area element of the map from the unit sphere."""
        return np.linalg.norm(direction * np.prod(self.semi_axes) / self.semi_axes, axis=1)

    @cached_property
    def area(self) -> float:
        return _over_sphere(self._stretch)

    def candidates(self, count: int, rng: Rng) -> Array:
        bound = np.prod(self.semi_axes) / self.c
        return reject(directions, self._stretch, bound, count, rng) * self.semi_axes

    def inside(self, x: Array) -> NDArray[np.bool_]:
        return np.sum((x / self.semi_axes) ** 2, axis=1) < 1.0

    def field(self, x: Array) -> Array:
        return np.where(self.inside(x), -1.0, 1.0) * distance.to_ellipsoid(
            x, (self.a, self.b, self.c)
        )

    @property
    def axis_ellipse(self) -> tuple[float, float]:
        return (self.a**2 - self.c**2) / self.a, (self.b**2 - self.c**2) / self.b

    def axis_distance(self, x: Array) -> Array:
        p, q = self.axis_ellipse
        over = (x[:, 0] / p) ** 2 + (x[:, 1] / q) ** 2 <= 1.0
        beside = distance.to_ellipsoid(x[:, :2], (p, q))
        return np.where(over, np.abs(x[:, 2]), np.hypot(x[:, 2], beside))

    def axis_points(self, count: int, seed: int = 0) -> Array:
        rng = np.random.default_rng(seed)
        turn, r = rng.random(count) * 2 * np.pi, np.sqrt(rng.random(count))
        p, q = self.axis_ellipse
        return np.column_stack((p * r * np.cos(turn), q * r * np.sin(turn), np.zeros(count)))

    def rim_points(self, count: int) -> Array:
        turn = (np.arange(count) + 0.5) * 2 * np.pi / count
        p, q = self.axis_ellipse
        return np.column_stack((p * np.cos(turn), q * np.sin(turn), np.zeros(count)))

    def axis_radius(self, x: Array) -> Array:
        """Radius of the medial ball at axis points."""
        squares = self.semi_axes**2
        return self.c * np.sqrt(
            np.maximum(0.0, 1.0 - np.sum(x[:, :2] ** 2 / (squares[:2] - squares[2]), axis=1))
        )


@dataclass(frozen=True)
class Prolate(Ellipsoid):
    """Turned round its longest axis, x: b = c < a, and the elliptical disc shrinks to the segment between two foci of
    curvature, |x| <= (a^2 - c^2) / a."""

    a: float = 1.0
    b: float = 0.5
    c: float = 0.5

    @property
    def end(self) -> float:
        return (self.a**2 - self.c**2) / self.a

    def axis_distance(self, x: Array) -> Array:
        return distance.to_segment(x, np.array([-self.end, 0, 0]), np.array([self.end, 0, 0]))

    def axis_points(self, count: int, seed: int = 0) -> Array:
        points = np.zeros((count, 3))
        points[:, 0] = (np.random.default_rng(seed).random(count) * 2 - 1) * self.end
        return points

    def rim_points(self, count: int) -> Array:
        return np.array([[-self.end, 0.0, 0.0], [self.end, 0.0, 0.0]])

    def axis_radius(self, x: Array) -> Array:
        return self.c * np.sqrt(np.maximum(0.0, 1.0 - x[:, 0] ** 2 / (self.a**2 - self.c**2)))


@dataclass(frozen=True)
class Shell(Shape):
    """All points closer than wall / 2 to an ellipsoid's surface, or a sphere's: a closed wall round a cavity."""

    a: float = 1.0
    b: float = 0.8
    c: float = 0.6
    wall: float = 0.1
    betti = (1, 0, 1)

    @property
    def middle(self) -> Ellipsoid:
        return Ellipsoid(self.a, self.b, self.c)

    def _curvatures(self, x: Array) -> tuple[Array, Array]:
        """Twice the mean curvature and the Gauss curvature of the middle surface."""
        squares = self.middle.semi_axes**2
        w = 1.0 / np.sqrt(np.sum(x**2 / squares**2, axis=1))
        twice_mean = w**3 * (squares.sum() - np.sum(x**2, axis=1)) / squares.prod()
        return twice_mean, w**4 / squares.prod()

    def _normals(self, x: Array) -> Array:
        normal = x / self.middle.semi_axes**2
        return normal / np.linalg.norm(normal, axis=1)[:, None]

    def _stretch(self, x: Array, offset: float) -> Array:
        twice_mean, gauss = self._curvatures(x)
        return 1.0 + offset * twice_mean + offset**2 * gauss

    def _sheet_area(self, offset: float) -> float:
        """Area of the middle surface's offset, by quadrature over the unit sphere."""
        m = self.middle
        return _over_sphere(lambda d: m._stretch(d) * self._stretch(d * m.semi_axes, offset))

    @cached_property
    def area(self) -> float:
        return sum(self._sheet_areas)

    @cached_property
    def _sheet_areas(self) -> tuple[float, float]:
        return self._sheet_area(self.wall / 2), self._sheet_area(-self.wall / 2)

    def candidates(self, count: int, rng: Rng) -> Array:
        half = self.wall / 2
        outer = int(shares(count, self._sheet_areas, rng)[0])
        sheets = [self._sheet(outer, half, rng), self._sheet(count - outer, -half, rng)]
        return rng.permutation(np.concatenate(sheets))

    def _sheet(self, count: int, offset: float, rng: Rng) -> Array:
        sharpest = (
            self.a / self.c**2
        )  # the largest principal curvature, at the ends of the longest axis
        bound = (1.0 + max(offset, 0.0) * sharpest) ** 2
        points = reject(
            self.middle.candidates, lambda x: self._stretch(x, offset), bound, count, rng
        )
        return points + offset * self._normals(points)

    def axis_distance(self, x: Array) -> Array:
        return distance.to_ellipsoid(x, (self.a, self.b, self.c))

    def field(self, x: Array) -> Array:
        return self.axis_distance(x) - self.wall / 2

    def axis_points(self, count: int, seed: int = 0) -> Array:
        return self.middle.candidates(count, np.random.default_rng(seed))


@dataclass(frozen=True)
class Sphere(Shape):
    """Its inner axis is one point; every facet of a sample on it is one too."""

    radius: float = 1.0

    @cached_property
    def area(self) -> float:
        return 4 * np.pi * self.radius**2

    def candidates(self, count: int, rng: Rng) -> Array:
        return self.radius * directions(count, rng)

    def field(self, x: Array) -> Array:
        return np.linalg.norm(x, axis=1) - self.radius

    def axis_distance(self, x: Array) -> Array:
        return np.linalg.norm(x, axis=1)

    def axis_points(self, count: int, seed: int = 0) -> Array:
        return np.zeros((count, 3))
