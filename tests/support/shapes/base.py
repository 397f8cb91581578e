# SPDX-License-Identifier: GPL-3.0-or-later
"""The base class of shapes with a known medial axis, and random points."""

import numpy as np
from numpy.typing import NDArray
from support.sampling import poisson_disc

Array = NDArray[np.float64]
Rng = np.random.Generator


class Shape:
    """A solid. Subclasses give the area, area-uniform surface points and the truth."""

    area: float
    betti: tuple[int, int, int]  # of the inner axis

    def candidates(self, count: int, rng: Rng) -> Array:
        raise NotImplementedError

    def field(self, x: Array) -> Array:
        """Negative inside, zero on the surface, positive outside; its size is at most the distance to the surface."""
        raise NotImplementedError

    def inside(self, x: Array) -> NDArray[np.bool_]:
        return self.field(x) < 0.0

    def normals(self, x: Array) -> Array:
        """Outward unit normals at points of the surface."""
        steps = 1e-5 * np.eye(3)
        slope = np.column_stack([self.field(x + step) - self.field(x - step) for step in steps])
        return slope / np.linalg.norm(slope, axis=1)[:, None]

    def axis_distance(self, x: Array) -> Array:
        raise NotImplementedError

    def axis_points(self, count: int, seed: int = 0) -> Array:
        raise NotImplementedError

    def axis_radius(self, x: Array) -> Array:
        """Radius of the medial ball at points of the inner axis: here the field is the exact distance."""
        return -self.field(x)

    def rim_points(self, count: int) -> Array:
        """About `count` points of the axis' border, where the medial angle vanishes; none for other axes."""
        return np.empty((0, 3))

    def sample(self, n: int, seed: int = 0) -> Array:
        """About n maximal Poisson-disc samples (within 1 %)."""
        return poisson_disc(self.candidates, self.area, n, seed)

    def random_sample(self, n: int, seed: int = 0) -> Array:
        """Exactly n independent area-uniform samples: cheap and uneven."""
        return self.candidates(n, np.random.default_rng(seed))


def directions(count: int, rng: Rng) -> Array:
    vectors = rng.normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def reject(throw, weight, bound: float, count: int, rng: Rng) -> Array:
    """Points of `throw`, kept with probability weight / bound, until there are `count`."""
    kept, total = [], 0
    while total < count:
        points = throw(count, rng)
        kept.append(points[rng.random(count) * bound < weight(points)])
        total += len(kept[-1])
    return np.concatenate(kept)[:count]


def shares(count: int, areas: Array, rng: Rng) -> NDArray[np.int64]:
    return rng.multinomial(count, np.asarray(areas) / np.sum(areas))
