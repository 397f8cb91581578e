# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids whose thickness varies, with inner and outer axes that are known exactly."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from support import distance

from .base import Array, Rng, Shape, directions, reject, shares
from .ellipsoids import Ellipsoid
from .thick import OnSegment


@dataclass(frozen=True)
class RoundCone(OnSegment):
    """The convex hull of two balls: the axis is the segment |x| <= length between their centres, on which the radius
    falls evenly from `big` to `small`. It has no outer axis."""

    length: float = 1.0
    big: float = 0.5
    small: float = 0.2
    betti = (1, 0, 0)

    @property
    def _slope(self) -> float:
        """The decrease of the radius along the axis, which is also the x of the unit normal on the cone."""
        return (self.big - self.small) / (2 * self.length)

    @property
    def _areas(self) -> list[float]:
        k = self._slope
        side = 2 * np.pi * (1 - k * k) * self.length * (self.big + self.small)
        return [side, 2 * np.pi * self.big**2 * (1 + k), 2 * np.pi * self.small**2 * (1 - k)]

    @cached_property
    def area(self) -> float:
        return float(sum(self._areas))

    def candidates(self, count: int, rng: Rng) -> Array:
        side, _, at_small = shares(count, self._areas, rng)
        k = self._slope
        x = rng.uniform(-1.0, k, count)  # of the unit normal: the ball at the big end
        x[:side], x[side : side + at_small] = k, rng.uniform(k, 1.0, at_small)
        turn = rng.random(count) * 2 * np.pi
        round_it = np.sqrt(1 - x * x)
        normal = np.column_stack((x, round_it * np.cos(turn), round_it * np.sin(turn)))
        centre = np.full(count, -self.length)
        centre[side : side + at_small] = self.length
        # The rings of the cone are the larger the larger the radius: u is the share of the area from the big end.
        u = rng.random(side)
        ring = np.sqrt(self.big**2 - u * (self.big**2 - self.small**2))
        centre[:side] = self.length * (self.big + self.small - 2 * ring) / (self.big - self.small)
        points = self.axis_radius_at(centre)[:, None] * normal
        points[:, 0] += centre
        return rng.permutation(points)

    def axis_radius_at(self, x: Array) -> Array:
        return (self.big + self.small) / 2 - self._slope * x

    def _centre(self, x: Array) -> Array:
        """Where on the axis the ball is whose sphere is nearest."""
        k = self._slope
        along = x[:, 0] - k / np.sqrt(1 - k * k) * np.hypot(x[:, 1], x[:, 2])
        return np.clip(along, -self.length, self.length)

    def field(self, x: Array) -> Array:
        centre = self._centre(x)
        away = np.sqrt((x[:, 0] - centre) ** 2 + x[:, 1] ** 2 + x[:, 2] ** 2)
        return away - self.axis_radius_at(centre)

    def axis_radius(self, x: Array) -> Array:
        return self.axis_radius_at(x[:, 0])


@dataclass(frozen=True)
class EccentricShell(Shape):
    """A ball round the origin with a ball-shaped cavity, off the centre by `shift` along x.

    As far from the outer sphere as from the inner one are the points whose distances to the two centres add up to the
    sum of the radii: an ellipsoid of revolution, whose foci the centres are. The origin lies in the cavity, so the
    inner axis has no more; the outer axis is the centre of the cavity.
    """

    radius: float = 1.0
    cavity: float = 0.5
    shift: float = 0.25
    betti = (1, 0, 1)

    @property
    def centre(self) -> Array:
        return np.array([self.shift, 0.0, 0.0])

    @property
    def middle(self) -> Ellipsoid:
        """The inner axis, about the middle of the two centres."""
        half = (self.radius + self.cavity) / 2
        short = np.sqrt(half**2 - self.shift**2 / 4)
        return Ellipsoid(half, short, short)

    @property
    def _areas(self) -> Array:
        return 4 * np.pi * np.array([self.radius, self.cavity]) ** 2

    @cached_property
    def area(self) -> float:
        return float(self._areas.sum())

    def candidates(self, count: int, rng: Rng) -> Array:
        outer = int(shares(count, self._areas, rng)[0])
        points = directions(count, rng)
        points[:outer] *= self.radius
        points[outer:] = self.cavity * points[outer:] + self.centre
        return rng.permutation(points)

    def field(self, x: Array) -> Array:
        away = np.linalg.norm(x - self.centre, axis=1)
        return np.maximum(np.linalg.norm(x, axis=1) - self.radius, self.cavity - away)

    def axis_distance(self, x: Array) -> Array:
        m = self.middle
        return distance.to_ellipsoid(x - self.centre / 2, (m.a, m.b, m.c))

    def axis_points(self, count: int, seed: int = 0) -> Array:
        return self.middle.candidates(count, np.random.default_rng(seed)) + self.centre / 2

    def outer_axis_distance(self, x: Array) -> Array:
        return np.linalg.norm(x - self.centre, axis=1)


@dataclass(frozen=True)
class Cyclide(Shape):
    """Dupin's ring cyclide: a bent tube whose radius changes from d - c to d + c.

    It is what an inversion makes of a torus, so the axes are what becomes of the torus' axes: inside the ellipse with
    the semi-axes a and b in the plane z = 0, outside the branch x > 0 of the hyperbola with the semi-axes c and b in
    the plane y = 0: the two focal conics of Dupin and Maxwell.
    """

    a: float = 1.0
    c: float = 0.2
    d: float = 0.4
    betti = (1, 1, 0)

    @property
    def b(self) -> float:
        return float(np.sqrt(self.a**2 - self.c**2))

    def surface(self, u: Array, v: Array) -> Array:
        """(n, 3) points; u goes round the ellipse, v round the tube."""
        a, b, c, d = self.a, self.b, self.c, self.d
        below = a - c * np.cos(u) * np.cos(v)
        x = d * (c - a * np.cos(u) * np.cos(v)) + b * b * np.cos(u)
        y = b * np.sin(u) * (a - d * np.cos(v))
        z = b * np.sin(v) * (c * np.cos(u) - d)
        return np.column_stack((x, y, z)) / below[:, None]

    def _stretch(self, u: Array, v: Array) -> Array:
        """Area element; u and v are the lines of curvature, so they are perpendicular."""
        step = 1e-6
        along = self.surface(u + step, v) - self.surface(u - step, v)
        across = self.surface(u, v + step) - self.surface(u, v - step)
        return np.linalg.norm(np.cross(along, across), axis=1) / (4 * step * step)

    @cached_property
    def _grid_stretch(self) -> Array:
        turn = np.arange(400) * 2 * np.pi / 400
        u, v = np.meshgrid(turn, turn)
        return self._stretch(u.ravel(), v.ravel())

    @cached_property
    def area(self) -> float:
        return float(self._grid_stretch.mean() * 4 * np.pi**2)

    def candidates(self, count: int, rng: Rng) -> Array:
        places = reject(
            lambda n, r: r.random((n, 2)) * 2 * np.pi,
            lambda p: self._stretch(p[:, 0], p[:, 1]),
            1.01 * float(self._grid_stretch.max()),
            count,
            rng,
        )
        return self.surface(places[:, 0], places[:, 1])

    def _quartic(self, x: Array) -> Array:
        lifted = np.sum(x * x, axis=1) + self.b**2 - self.d**2
        side = self.a * x[:, 0] - self.c * self.d
        return lifted**2 - 4 * side**2 - 4 * self.b**2 * x[:, 1] ** 2

    def inside(self, x: Array) -> NDArray[np.bool_]:
        return self._quartic(x) < 0.0

    def normals(self, x: Array) -> Array:
        lifted = np.sum(x * x, axis=1) + self.b**2 - self.d**2
        slope = 4 * lifted[:, None] * x
        slope[:, 0] -= 8 * self.a * (self.a * x[:, 0] - self.c * self.d)
        slope[:, 1] -= 8 * self.b**2 * x[:, 1]
        return slope / np.linalg.norm(slope, axis=1)[:, None]

    def axis_distance(self, x: Array) -> Array:
        return np.hypot(distance.to_ellipsoid(x[:, :2], (self.a, self.b)), x[:, 2])

    def axis_points(self, count: int, seed: int = 0) -> Array:
        """Uniform in the angle of the ellipse."""
        u = np.random.default_rng(seed).random(count) * 2 * np.pi
        return np.column_stack((self.a * np.cos(u), self.b * np.sin(u), np.zeros(count)))

    def axis_radius(self, x: Array) -> Array:
        return self.d - self.c * x[:, 0] / self.a

    def hyperbola(self, t: Array) -> Array:
        """(n, 3) points of the outer axis; z = b sinh t."""
        return np.stack((self.c * np.cosh(t), 0 * t, self.b * np.sinh(t)), -1)

    def outer_axis_distance(self, x: Array) -> Array:
        """Exact for |z| < 10 b."""
        reach = 3.0
        return distance.to_curve(
            x,
            lambda t: self.hyperbola(t - reach),
            lambda t: np.stack(
                (self.c * np.sinh(t - reach), 0 * t, self.b * np.cosh(t - reach)), -1
            ),
            2 * reach,
        )
