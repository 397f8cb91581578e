# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of solids as formulas: where the nearest point of a face is, and which way is in.

Faces come from profiles: a loop of segments and arcs with the solid on its left, moved along z or turned round z.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True)
class Feet:
    """The nearest points of a curve or of a wall.

    Parameters
    ----------
    points : (n, d)
    inward : (n, d)
        Unit normals into the solid.
    clipped : (n,)
        The foot is on the border, and the line to it is not along the normal.
    """

    points: Array
    inward: Array
    clipped: Bools


# --- curves in the plane


@dataclass(frozen=True)
class Segment:
    start: tuple[float, float]
    end: tuple[float, float]
    focal = None

    def feet(self, u: Array) -> Feet:
        start, along = np.array(self.start), np.subtract(self.end, self.start)
        length = np.linalg.norm(along)
        t = (u - start) @ (along / length)
        kept = np.clip(t, 0.0, length)
        inward = np.array([-along[1], along[0]]) / length
        points = start + kept[:, None] * (along / length)
        return Feet(points, np.broadcast_to(inward, u.shape), kept != t)

    def at(self, t: Array) -> Array:
        return np.array(self.start) + t[:, None] * np.subtract(self.end, self.start)

    @property
    def length(self) -> float:
        return float(np.linalg.norm(np.subtract(self.end, self.start)))


@dataclass(frozen=True)
class Arc:
    """Part of a circle, from an angle on; a negative sweep is that of a hole, whose solid is outside."""

    centre: tuple[float, float]
    radius: float
    start: float = 0.0
    sweep: float = 2 * np.pi

    @property
    def whole(self) -> bool:
        return abs(self.sweep) >= 2 * np.pi

    @property
    def focal(self) -> float | None:
        """Radius of the largest ball at a point, if nothing else is in its way; a whole circle is in its own way."""
        return self.radius if self.sweep > 0 and not self.whole else None

    @property
    def length(self) -> float:
        return abs(self.sweep) * self.radius

    def at(self, t: Array) -> Array:
        angle = self.start + t * self.sweep
        return self.centre + self.radius * np.column_stack((np.cos(angle), np.sin(angle)))

    def feet(self, u: Array) -> Feet:
        out = u - self.centre
        size = np.linalg.norm(out, axis=1)
        out = np.where(
            size[:, None] > 0, out / np.where(size > 0, size, 1.0)[:, None], self._middle
        )
        turn = np.sign(self.sweep) * (np.arctan2(out[:, 1], out[:, 0]) - self.start)
        beyond = np.mod(turn, 2 * np.pi) > abs(self.sweep)
        if beyond.any() and not self.whole:
            ends = self.at(np.array([0.0, 1.0]))
            far = np.linalg.norm(u[beyond][:, None] - ends, axis=2)
            out = out.copy()
            out[beyond] = (ends[np.argmin(far, axis=1)] - self.centre) / self.radius
        clipped = beyond & (not self.whole)
        return Feet(self.centre + self.radius * out, -np.sign(self.sweep) * out, clipped)

    @property
    def _middle(self) -> Array:
        angle = self.start + self.sweep / 2
        return np.array([np.cos(angle), np.sin(angle)])


@dataclass(frozen=True)
class Opposite:
    """The far side of a whole circle: where its own axis has the second contact."""

    arc: Arc
    focal = None

    def feet(self, u: Array) -> Feet:
        return self.arc.feet(2 * np.array(self.arc.centre) - u)


Curve = Segment | Arc | Opposite


def polygon(*corners: tuple[float, float]) -> tuple[Segment, ...]:
    """A loop of segments, counter-clockwise."""
    return tuple(Segment(a, b) for a, b in zip(corners, (*corners[1:], corners[0])))


def circle(radius: float, hole: bool = False) -> tuple[Arc, ...]:
    return (Arc((0.0, 0.0), radius, 0.0, -2 * np.pi if hole else 2 * np.pi),)


# --- walls in space


@dataclass(frozen=True)
class Upright:
    """A curve moved along z."""

    curve: Curve
    half: float

    @property
    def focal(self) -> float | None:
        return self.curve.focal

    def feet(self, x: Array) -> Feet:
        flat = self.curve.feet(x[:, :2])
        z = np.clip(x[:, 2], -self.half, self.half)
        inward = np.column_stack((flat.inward, np.zeros(len(x))))
        return Feet(np.column_stack((flat.points, z)), inward, flat.clipped | (z != x[:, 2]))


@dataclass(frozen=True)
class Level:
    """A plane across z, for points whose foot is on the face: all of the solid."""

    z: float
    inward: float
    focal = None

    def feet(self, x: Array) -> Feet:
        points = np.column_stack((x[:, :2], np.full(len(x), self.z)))
        inward = np.broadcast_to((0.0, 0.0, self.inward), x.shape)
        return Feet(points, inward, np.zeros(len(x), bool))


@dataclass(frozen=True)
class Turned:
    """A segment of the half plane (rho, z) turned round z: its near side, or its far one."""

    curve: Segment
    far: bool = False
    focal = None

    def feet(self, x: Array) -> Feet:
        rho = np.hypot(x[:, 0], x[:, 1])
        safe = np.where(rho > 0, rho, 1.0)[:, None]
        out = np.where(rho[:, None] > 0, x[:, :2] / safe, (1.0, 0.0))
        out = -out if self.far else out
        flat = self.curve.feet(np.column_stack((-rho if self.far else rho, x[:, 2])))
        points, inward = (
            np.column_stack((y[:, :1] * out, y[:, 1])) for y in (flat.points, flat.inward)
        )
        return Feet(points, inward, flat.clipped)


Wall = Upright | Level | Turned


def of_prism(loops: tuple[tuple[Curve, ...], ...], half: float) -> tuple[Wall, ...]:
    """The walls of a profile between z = -half and z = half."""
    curves = [curve for loop in loops for curve in loop]
    curves += [Opposite(c) for c in curves if isinstance(c, Arc) and c.whole and c.sweep > 0]
    return (*(Upright(curve, half) for curve in curves), Level(-half, 1.0), Level(half, -1.0))


def of_cone(radius: float, half: float) -> tuple[Wall, ...]:
    """A cone with its base at z = -half and its tip at z = half."""
    side = Segment((radius, -half), (0.0, half))
    return (Turned(side), Turned(side, far=True), Level(-half, 1.0))
