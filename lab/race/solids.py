# SPDX-License-Identifier: GPL-3.0-or-later
"""The solids of the race: what is known exactly of each, and seeded samples of it, clean and noisy."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from support import shapes
from support.shapes import SHAPES, Array, Shape

NOISE = 0.1
"""Standard deviation of the noisy samples, along the normals, in spacings sqrt(area / n)."""


@dataclass(frozen=True)
class Solid:
    """A shape, and what the exact inner axis of it measures.

    Parameters
    ----------
    shape : Shape
    parts : str
        What the inner axis consists of, for people.
    area : float
        Of the sheets of the inner axis.
    length : float
        Of its curves.
    outer : str
        What the outer axis is, for people; "none" for convex solids, "not known".
    """

    shape: Shape
    parts: str
    area: float
    length: float
    outer: str = "none"

    @property
    def sheets(self) -> bool:
        return self.area > 0.0

    def spacing(self, n: int) -> float:
        return math.sqrt(self.shape.area / n)


def samples(solid: Solid, n: int, noisy: bool, seed: int = 0) -> tuple[Array, Array]:
    """About n (k, 3) points, and the (k, 3) outward unit normals of the exact surface there."""
    points = solid.shape.sample(n, seed)
    normals = solid.shape.normals(points)
    if noisy:
        away = np.random.default_rng((seed, 1)).normal(size=(len(points), 1))
        points = points + NOISE * solid.spacing(len(points)) * away * normals
    return points, normals


# --- what the axes measure


def _ellipse(shape: shapes.Ellipsoid) -> float:
    p, q = shape.axis_ellipse
    return math.pi * p * q


def _triangles(shape: shapes.Box) -> float:
    a, b, c = shape.axis_triangles().transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def _closed(curve: Callable[[Array], Array], steps: int = 20_000) -> float:
    points = curve(np.arange(steps) * 2 * math.pi / steps)
    return float(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum())


def _of_ellipsoid(shape: shapes.Ellipsoid) -> Solid:
    return Solid(shape, "sheet", _ellipse(shape), 0.0)


def _of_lathe(shape: shapes.Lathe) -> Solid:
    segments = shape.axis_segments
    curves = segments[segments[:, :, 0].sum(axis=1) < 1e-12]  # those on the z axis stay curves
    length = float(np.linalg.norm(curves[:, 1] - curves[:, 0], axis=1).sum())
    return Solid(shape, "sheets and a curve" if length else "sheets", shape.axis_area, length)


def _all() -> dict[str, Solid]:
    slab, box = SHAPES["slab"], SHAPES["box"]
    torus, capsule, knot, shell = (SHAPES[name] for name in ("torus", "capsule", "knot", "shell"))
    plate, cone, eccentric = shapes.HoledPlate(), shapes.RoundCone(), shapes.EccentricShell()
    cyclide, prolate = shapes.Cyclide(), shapes.Prolate()
    return {
        "ellipsoid": _of_ellipsoid(SHAPES["ellipsoid"]),
        "slab": Solid(slab, "sheet", 4 * slab.width * slab.depth, 0.0),
        "holed plate": Solid(plate, "sheet with two holes", plate.sheet_area, 0.0, "two lines"),
        "box": Solid(box, "sheets to sharp edges", _triangles(box), 0.0),
        "cylinder": _of_lathe(shapes.cylinder(0.5, 1.0)),
        "cone": _of_lathe(shapes.frustum(0.8, 0.0, 0.8)),
        "shell": Solid(shell, "closed sheet", shell.middle.area, 0.0, "disc in the cavity"),
        "eccentric shell": Solid(
            eccentric, "closed sheet", eccentric.middle.area, 0.0, "point in the cavity"
        ),
        "torus": Solid(torus, "closed curve", 0.0, 2 * math.pi * torus.big, "line"),
        "knot": Solid(knot, "closed curve", 0.0, knot.length, "not known"),
        "cyclide": Solid(
            cyclide,
            "closed curve",
            0.0,
            _closed(lambda u: np.column_stack((cyclide.a * np.cos(u), cyclide.b * np.sin(u)))),
            "hyperbola",
        ),
        "capsule": Solid(capsule, "curve", 0.0, 2 * capsule.length),
        "round cone": Solid(cone, "curve", 0.0, 2 * cone.length),
        "prolate": Solid(prolate, "curve", 0.0, 2 * prolate.end),
    }


SOLIDS: dict[str, Solid] = _all()


# --- the outer axis


def outer_distance(name: str, x: Array) -> Array | None:
    """(n,) distance to the exact outer axis; None where there is none, or where it is not known."""
    shape = SOLIDS[name].shape
    if name == "shell":
        return shape.middle.axis_distance(x)
    exact = getattr(shape, "outer_axis_distance", None)
    return None if exact is None else exact(x)


def box_of(shape: Shape, seed: int = 0) -> tuple[Array, Array]:
    """Corners of the box round the surface, in which outer axes are judged."""
    points = shape.random_sample(20_000, seed)
    return points.min(axis=0), points.max(axis=0)


def outer_points(name: str, count: int, seed: int = 0) -> Array:
    """(k, 3) points of the exact outer axis in the box of the shape."""
    solid, rng = SOLIDS[name].shape, np.random.default_rng(seed)
    low, high = box_of(solid)
    z = rng.uniform(low[2], high[2], count)
    if name == "torus":
        return np.column_stack((0 * z, 0 * z, z))
    if name == "holed plate":
        return np.column_stack((rng.choice(solid.centres, count), 0 * z, z))
    if name == "cyclide":
        return solid.hyperbola(np.arcsinh(z / solid.b))
    if name == "shell":
        return solid.middle.axis_points(count, seed)
    if name == "eccentric shell":
        return solid.centre[None]
    return np.empty((0, 3))


def within(x: Array, box: tuple[Array, Array]) -> NDArray[np.bool_]:
    return np.all((x >= box[0]) & (x <= box[1]), axis=1)
