"""Solids whose medial axes are known exactly, with seeded blue-noise samplers of their surfaces.

Every shape has `sample(n, seed)`, `field(x)`, `inside(x)`, `normals(x)`, `axis_distance(x)` (exact distance to the
inner axis) and `axis_points(m, seed)` (uniform points of the inner axis). Truth formulas: oblate and triaxial
ellipsoid: a disc or solid ellipse with semi-axes (a^2 - c^2)/a and (b^2 - c^2)/b; rounded slab: the rectangle;
shell: the middle surface; convex polytope: for each pair of faces the polygon where both are nearest; tube: the curve.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import distance
import numpy as np
from numpy.typing import NDArray
from sampling import poisson_disc

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

    def rim_points(self, count: int) -> Array:
        """About `count` points of the axis' border, where the medial angle vanishes; none for other axes."""
        return np.empty((0, 3))

    def sample(self, n: int, seed: int = 0) -> Array:
        """About n maximal Poisson-disc samples (within 1 %)."""
        return poisson_disc(self.candidates, self.area, n, seed)

    def random_sample(self, n: int, seed: int = 0) -> Array:
        """Exactly n independent area-uniform samples: cheap and uneven."""
        return self.candidates(n, np.random.default_rng(seed))


def _directions(count: int, rng: Rng) -> Array:
    vectors = rng.normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def _reject(throw, weight, bound: float, count: int, rng: Rng) -> Array:
    """Points of `throw`, kept with probability weight / bound, until there are `count`."""
    kept, total = [], 0
    while total < count:
        points = throw(count, rng)
        kept.append(points[rng.random(count) * bound < weight(points)])
        total += len(kept[-1])
    return np.concatenate(kept)[:count]


def _shares(count: int, areas: Array, rng: Rng) -> NDArray[np.int64]:
    return rng.multinomial(count, np.asarray(areas) / np.sum(areas))


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
        z, weight = np.polynomial.legendre.leggauss(200)
        turn = (np.arange(400) + 0.5) * np.pi / 200.0
        ring = np.sqrt(1.0 - z**2)
        grid = np.stack(
            np.broadcast_arrays(
                ring[:, None] * np.cos(turn), ring[:, None] * np.sin(turn), z[:, None]
            ),
            -1,
        )
        return float(
            (self._stretch(grid.reshape(-1, 3)).reshape(200, 400).mean(axis=1) * weight).sum()
            * 2
            * np.pi
        )

    def candidates(self, count: int, rng: Rng) -> Array:
        bound = np.prod(self.semi_axes) / self.c
        return _reject(_directions, self._stretch, bound, count, rng) * self.semi_axes

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
        flat, along_x, along_y, _ = shares = _shares(count, self._areas, rng)
        core = (rng.random((count, 2)) * 2 - 1) * (self.width, self.depth)
        normal = _directions(count, rng)
        start = np.cumsum(shares)
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
class Shell(Shape):
    """All points closer than wall / 2 to an ellipsoid's surface: a closed wall round a cavity."""

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
        m, e = self.middle, self.middle.semi_axes
        z, weight = np.polynomial.legendre.leggauss(200)
        turn = (np.arange(400) + 0.5) * np.pi / 200.0
        ring = np.sqrt(1.0 - z**2)
        grid = np.stack(
            np.broadcast_arrays(
                ring[:, None] * np.cos(turn), ring[:, None] * np.sin(turn), z[:, None]
            ),
            -1,
        )
        grid = grid.reshape(-1, 3)
        element = m._stretch(grid) * self._stretch(grid * e, offset)
        return float((element.reshape(200, 400).mean(axis=1) * weight).sum() * 2 * np.pi)

    @cached_property
    def area(self) -> float:
        return sum(self._sheet_areas)

    @cached_property
    def _sheet_areas(self) -> tuple[float, float]:
        return self._sheet_area(self.wall / 2), self._sheet_area(-self.wall / 2)

    def candidates(self, count: int, rng: Rng) -> Array:
        half = self.wall / 2
        outer = int(_shares(count, self._sheet_areas, rng)[0])
        sheets = [self._sheet(outer, half, rng), self._sheet(count - outer, -half, rng)]
        return rng.permutation(np.concatenate(sheets))

    def _sheet(self, count: int, offset: float, rng: Rng) -> Array:
        sharpest = (
            self.a / self.c**2
        )  # the largest principal curvature, at the ends of the longest axis
        bound = (1.0 + max(offset, 0.0) * sharpest) ** 2
        points = _reject(
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
class Box(Shape):
    """Half sizes along x, y and z."""

    x: float = 1.0
    y: float = 0.7
    z: float = 0.4
    betti = (1, 0, 0)

    @property
    def half(self) -> Array:
        return np.array([self.x, self.y, self.z])

    @cached_property
    def area(self) -> float:
        return 8.0 * (self.x * self.y + self.y * self.z + self.z * self.x)

    def candidates(self, count: int, rng: Rng) -> Array:
        points = (rng.random((count, 3)) * 2 - 1) * self.half
        axis = rng.choice(3, size=count, p=1.0 / self.half / np.sum(1.0 / self.half))
        points[np.arange(count), axis] = self.half[axis] * rng.choice([-1.0, 1.0], count)
        return points

    def field(self, x: Array) -> Array:
        return np.max(np.abs(x) - self.half, axis=1)

    def axis_triangles(self) -> Array:
        """(m, 3, 3): the axis, cut into triangles."""
        planes = [(sign * np.eye(3)[k], self.half[k]) for k in range(3) for sign in (1.0, -1.0)]
        triangles = []
        for first, second in combinations(planes, 2):
            others = [plane for plane in planes if plane is not first and plane is not second]
            triangles += _fan(_bisector(*first, *second, others))
        return np.array(triangles)

    def axis_distance(self, x: Array) -> Array:
        return np.min([distance.to_triangle(x, t) for t in self.axis_triangles()], axis=0)

    def axis_points(self, count: int, seed: int = 0) -> Array:
        return distance.points_on_triangles(
            self.axis_triangles(), count, np.random.default_rng(seed)
        )


def _bisector(n: Array, d: float, m: Array, e: float, others: list) -> Array:
    """Polygon of the points that are as far from face (n, d) as from (m, e) and no farther from any other."""
    normal = (n - m) / np.linalg.norm(n - m)
    u = np.eye(3)[np.argmin(np.abs(normal))]
    u = np.cross(normal, u)
    v = np.cross(normal, u)
    centre = normal * (d - e) / np.linalg.norm(n - m)
    polygon = [centre + 10 * (i * u + j * v) for i, j in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    polygon = _clip(polygon, n, d)
    for k, f in others:
        polygon = _clip(polygon, k - n, f - d)
    return np.array(polygon)


def _clip(polygon: list, normal: Array, offset: float) -> list:
    """The part of a polygon where normal . x <= offset."""
    height = [float(normal @ x) - offset for x in polygon]
    kept = []
    for i, x in enumerate(polygon):
        before, h_before, h = polygon[i - 1], height[i - 1], height[i]
        if h * h_before < 0.0:
            kept.append(before + (x - before) * h_before / (h_before - h))
        if h <= 0.0:
            kept.append(x)
    return kept


def _fan(polygon: Array) -> list:
    """Triangles of a convex polygon, without those of no area."""
    triangles = [
        np.array([polygon[0], polygon[i], polygon[i + 1]]) for i in range(1, len(polygon) - 1)
    ]
    return [t for t in triangles if np.linalg.norm(np.cross(t[1] - t[0], t[2] - t[0])) > 1e-12]


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
        return _reject(self._throw, lambda x: np.hypot(x[:, 0], x[:, 1]), bound, count, rng)

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


@dataclass(frozen=True)
class Capsule(Shape):
    """The segment |x| <= length, thickened by a ball."""

    length: float = 1.0
    radius: float = 0.35
    betti = (1, 0, 0)

    @cached_property
    def area(self) -> float:
        return 4 * np.pi * self.radius * (self.length + self.radius)

    def candidates(self, count: int, rng: Rng) -> Array:
        side = int(_shares(count, [self.length, self.radius], rng)[0])
        normal = _directions(count, rng)
        turn = rng.random(side) * 2 * np.pi
        normal[:side] = np.column_stack((np.zeros(side), np.cos(turn), np.sin(turn)))
        core = self.length * np.sign(normal[:, 0])
        core[:side] = (rng.random(side) * 2 - 1) * self.length
        points = self.radius * normal
        points[:, 0] += core
        return rng.permutation(points)

    def axis_distance(self, x: Array) -> Array:
        return distance.to_segment(x, np.array([-self.length, 0, 0]), np.array([self.length, 0, 0]))

    def field(self, x: Array) -> Array:
        return self.axis_distance(x) - self.radius

    def axis_points(self, count: int, seed: int = 0) -> Array:
        points = np.zeros((count, 3))
        points[:, 0] = (np.random.default_rng(seed).random(count) * 2 - 1) * self.length
        points[:2, 0] = (-self.length, self.length)
        return points


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


@dataclass(frozen=True)
class Sphere(Shape):
    """Its inner axis is one point; every facet of a sample on it is one too."""

    radius: float = 1.0

    @cached_property
    def area(self) -> float:
        return 4 * np.pi * self.radius**2

    def candidates(self, count: int, rng: Rng) -> Array:
        return self.radius * _directions(count, rng)

    def field(self, x: Array) -> Array:
        return np.linalg.norm(x, axis=1) - self.radius

    def axis_distance(self, x: Array) -> Array:
        return np.linalg.norm(x, axis=1)

    def axis_points(self, count: int, seed: int = 0) -> Array:
        return np.zeros((count, 3))


def grid_cube(cells: int = 8) -> Array:
    """The surface points of a cubic grid of cells^3 unit cubes, centred: half size cells / 2.

    Its inner facets are known: on each of the 12 triangles of the cube's axis 1 + 3 + ... + (cells - 1) for even cells.
    """
    axis = np.arange(cells + 1) - cells / 2
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    return points[np.abs(points).max(axis=1) == cells / 2]


SHAPES: dict[str, Shape] = {
    "ellipsoid": Ellipsoid(),
    "oblate": Ellipsoid(1.0, 1.0, 0.5),
    "slab": Slab(),
    "shell": Shell(),
    "box": Box(),
    "torus": Torus(),
    "capsule": Capsule(),
    "knot": Knot(),
}
