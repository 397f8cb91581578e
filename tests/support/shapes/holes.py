# SPDX-License-Identifier: GPL-3.0-or-later
"""A rounded plate with round holes: its axis is a sheet with holes, and each hole has a line for an outer axis."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .base import Array, Rng, Shape, shares
from .thick import Slab


@dataclass(frozen=True)
class HoledPlate(Shape):
    """The rectangle |x| <= width, |y| <= depth without discs round (centre, 0), thickened by a ball that is smaller
    than they: of as many handles as there are holes.

    A point has two nearest ones in the plate only above or below the centre of a hole: the outer axis is the lines
    through the centres, upright. The surface of the thickened plate is parallel, so both axes are those of the plate.
    """

    width: float = 1.2
    depth: float = 0.7
    radius: float = 0.15
    hole: float = 0.3
    centres: tuple[float, ...] = (-0.55, 0.55)

    @property
    def betti(self) -> tuple[int, int, int]:
        return (1, len(self.centres), 0)

    @property
    def _slab(self) -> Slab:
        return Slab(self.width, self.depth, self.radius)

    @property
    def sheet_area(self) -> float:
        return 4 * self.width * self.depth - len(self.centres) * np.pi * self.hole**2

    @property
    def _areas(self) -> list[float]:
        """The areas of the slab without holes and of the walls of the holes."""
        wall = 2 * np.pi * self.radius * (np.pi * self.hole - 2 * self.radius)
        return [self._slab.area, len(self.centres) * wall]

    @cached_property
    def area(self) -> float:
        return float(sum(self._areas)) - 2 * len(self.centres) * np.pi * self.hole**2

    def candidates(self, count: int, rng: Rng) -> Array:
        kept, total = [], 0
        while total < count:
            plain, walls = shares(count, self._areas, rng)
            points = self._slab.candidates(plain, rng)
            points = points[self._depth_in_hole(points) <= 0.0]
            kept.append(rng.permutation(np.concatenate((points, self._walls(walls, rng)))))
            total += len(kept[-1])
        return np.concatenate(kept)[:count]

    def _walls(self, count: int, rng: Rng) -> Array:
        """The inner halves of tori."""
        height = np.empty(0)
        while len(height) < count:
            angle = (rng.random(2 * count + 8) - 0.5) * np.pi
            weight = self.hole - self.radius * np.cos(angle)
            height = np.append(height, angle[rng.random(len(angle)) * self.hole < weight])
        angle, turn = height[:count], rng.random(count) * 2 * np.pi
        out = self.hole - self.radius * np.cos(angle)
        centre = np.array(self.centres)[rng.integers(len(self.centres), size=count)]
        return np.column_stack(
            (centre + out * np.cos(turn), out * np.sin(turn), self.radius * np.sin(angle))
        )

    def _from_centres(self, x: Array) -> Array:
        """(n,) in the plane, from the nearest centre of a hole."""
        return np.min([np.hypot(x[:, 0] - c, x[:, 1]) for c in self.centres], axis=0)

    def _depth_in_hole(self, x: Array) -> Array:
        """How far in the plane from the wall of a hole; negative outside of all."""
        return self.hole - self._from_centres(x)

    def axis_distance(self, x: Array) -> Array:
        beside = np.maximum(np.abs(x[:, :2]) - (self.width, self.depth), 0.0)
        flat = np.maximum(np.linalg.norm(beside, axis=1), self._depth_in_hole(x))
        return np.hypot(flat, x[:, 2])

    def field(self, x: Array) -> Array:
        return self.axis_distance(x) - self.radius

    def axis_points(self, count: int, seed: int = 0) -> Array:
        rng = np.random.default_rng(seed)
        flat = (rng.random((3 * count, 2)) * 2 - 1) * (self.width, self.depth)
        points = np.column_stack((flat, np.zeros(3 * count)))
        return points[self._depth_in_hole(points) <= 0.0][:count]

    def rim_points(self, count: int) -> Array:
        turn = (np.arange(count // 4) + 0.5) * 2 * np.pi / (count // 4)
        circles = [
            np.column_stack(
                (c + self.hole * np.cos(turn), self.hole * np.sin(turn), np.zeros(len(turn)))
            )
            for c in self.centres
        ]
        return np.concatenate((self._slab.rim_points(count // 2), *circles))

    def outer_axis_distance(self, x: Array) -> Array:
        return self._from_centres(x)
