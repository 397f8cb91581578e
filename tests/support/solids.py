# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids whose surfaces have a known topology, for surface reconstruction: those of `shapes` and others."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .shapes import SHAPES, Array, Rng, Shape, Shell, Sphere


@dataclass(frozen=True)
class Wheel(Shape):
    """A tube round the unit circle and its spokes, smooth where they meet: a handlebody of genus `spokes`.

    The surface is where the smooth minimum of the distances to the circle and to the spokes is `radius`.
    """

    spokes: int = 2
    radius: float = 0.2
    sharpness: float = 15.0  # of the smooth minimum, per length
    band: float = 0.05  # half of the layer whose points are projected onto the surface

    @property
    def _box(self) -> Array:
        reach = self.radius + 2.0 * self.band
        return np.array([1.0 + reach, 1.0 + reach, reach])

    def _arms(self, x: Array) -> Array:
        """(spokes + 1, n, 3) from the nearest point of the circle and of each spoke to x."""
        turn = 2 * np.pi * np.arange(self.spokes) / self.spokes
        ends = np.column_stack((np.cos(turn), np.sin(turn), np.zeros(self.spokes)))
        on_spokes = np.clip(x @ ends.T, 0.0, 1.0).T[:, :, None] * ends[:, None]
        flat = x * (1.0, 1.0, 0.0)
        on_circle = flat / np.maximum(np.linalg.norm(flat, axis=1), 1e-300)[:, None]
        return x - np.concatenate((on_circle[None], on_spokes))

    def field(self, x: Array) -> Array:
        lengths = np.linalg.norm(self._arms(x), axis=2)
        nearest = lengths.min(axis=0)
        total = np.exp(-self.sharpness * (lengths - nearest)).sum(axis=0)
        return nearest - np.log(total) / self.sharpness - self.radius

    def _gradient(self, x: Array) -> Array:
        arms = self._arms(x)
        lengths = np.linalg.norm(arms, axis=2)
        weights = np.exp(-self.sharpness * (lengths - lengths.min(axis=0)))
        weights /= weights.sum(axis=0) * lengths
        return np.einsum("kn,knd->nd", weights, arms)

    def normals(self, x: Array) -> Array:
        gradient = self._gradient(x)
        return gradient / np.linalg.norm(gradient, axis=1)[:, None]

    @cached_property
    def area(self) -> float:
        x = self._throw(200_000, np.random.default_rng(0))
        return float(np.mean(self._in_band(x)) * np.prod(2 * self._box) / (2 * self.band))

    def _throw(self, count: int, rng: Rng) -> Array:
        return (rng.random((count, 3)) * 2 - 1) * self._box

    def _in_band(self, x: Array) -> NDArray[np.bool_]:
        return np.abs(self.field(x)) < self.band * np.linalg.norm(self._gradient(x), axis=1)

    def candidates(self, count: int, rng: Rng) -> Array:
        kept, total = [], 0
        while total < count:
            x = self._throw(count, rng)
            kept.append(self._project(x[self._in_band(x)]))
            total += len(kept[-1])
        return np.concatenate(kept)[:count]

    def _project(self, x: Array) -> Array:
        """Newton's method along the gradient."""
        for _ in range(5):
            gradient = self._gradient(x)
            x = x - (self.field(x) / np.sum(gradient**2, axis=1))[:, None] * gradient
        return x


@dataclass(frozen=True)
class Apart(Shape):
    """Disjoint solids, each moved; equally many samples of each, so that small ones are sampled densely."""

    parts: tuple[tuple[Shape, tuple[float, float, float]], ...]

    @property
    def area(self) -> float:
        return sum(shape.area for shape, _ in self.parts)

    def sample(self, n: int, seed: int = 0) -> Array:
        count = n // len(self.parts)
        return np.concatenate([shape.sample(count, seed) + shift for shape, shift in self.parts])

    def field(self, x: Array) -> Array:
        return np.min([shape.field(x - shift) for shape, shift in self.parts], axis=0)


@dataclass(frozen=True)
class Filled(Shape):
    """A shell's samples as those of the solid without its cavity: what can be seen of it from outside."""

    shell: Shell

    def sample(self, n: int, seed: int = 0) -> Array:
        return self.shell.sample(n, seed)

    def field(self, x: Array) -> Array:
        return self.shell.middle.field(x) - self.shell.wall / 2


@dataclass(frozen=True)
class Solid:
    """A shape and the components and the Euler characteristic of its surface."""

    shape: Shape
    components: int
    euler: int


SOLIDS: dict[str, Solid] = {
    "sphere": Solid(Sphere(), 1, 2),
    "two balls": Solid(Apart(((Sphere(), (0.0, 0.0, 0.0)), (Sphere(0.1), (1.3, 0.2, 0.1)))), 2, 4),
    "ellipsoid": Solid(SHAPES["ellipsoid"], 1, 2),
    "slab": Solid(SHAPES["slab"], 1, 2),
    "capsule": Solid(SHAPES["capsule"], 1, 2),
    "torus": Solid(SHAPES["torus"], 1, 0),
    "knot": Solid(SHAPES["knot"], 1, 0),
    "genus 2": Solid(Wheel(2), 1, -2),
    "genus 3": Solid(Wheel(3), 1, -4),
}
"""Smooth and closed: Tight Cocone reconstructs these from a few thousand samples."""
