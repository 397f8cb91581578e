# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed meshes of solids together with their exact faces, for axes that are measured to the last digit.

Flat faces have few triangles, curved ones many, and all vertices lie on the exact faces. `solid` makes them by name.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from . import distance, inputs, resampled, topology, walls
from .meshes import Mesh, weld
from .shape_meshes import MESHED
from .shapes import MORE_SHAPES, SHAPES, Ellipsoid
from .shapes.convex import axis_triangles_of_planes
from .walls import Arc, Array, Curve, Segment, Wall, circle, polygon

TINY = 1e-12  # of the diagonal: what rounding of a few operations stays below
NEAR = 1e-9  # of the diagonal: feet so close are one
SAME = 1e-6  # directions so close are one


@dataclass(frozen=True, eq=False)
class Solid:
    """A mesh and what is known of the solid that it approximates.

    Parameters
    ----------
    mesh : Mesh
    edges : (k, 3)
        Points of the convex edges and all convex corners, tips too.
    rim : float
        Length of the border of the sheets.
    area : float or None
        Of the sheets; None where no closed form is known.
    """

    mesh: Mesh
    edges: Array
    rim: float
    area: float | None
    betti: tuple[int, int, int]

    @cached_property
    def diagonal(self) -> float:
        return resampled.diagonal(self.mesh[0])

    @cached_property
    def surface(self) -> float:
        return topology.area(*self.mesh)

    @cached_property
    def straight_edges(self) -> Array:
        """(k, 3, 3) convex edges of the mesh on the exact faces, as triangles of two corners."""
        points, triangles = self.mesh
        sides = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        order = np.lexsort(np.sort(sides, axis=1).T)
        one, two = order.reshape(-1, 2).T
        a, b, c = points[triangles].transpose(1, 0, 2)
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        over = points[triangles[two // 3]].mean(axis=1) - points[sides[one, 0]]
        convex = np.einsum("ij,ij->i", normals[one // 3], over) < -SAME * self.diagonal
        exact = self.distance(points[sides[one]].mean(axis=1)) < TINY * self.diagonal
        return points[sides[one]][:, [0, 1, 1]][convex & exact]

    def spacing(self, count: int) -> float:
        return resampled.spacing(self.surface, count)

    def distance(self, x: Array) -> Array:
        """(n,) from points inside to the exact faces."""
        raise NotImplementedError

    def off_axis(self, x: Array) -> Array:
        """(n,) to the exact axis, in first order."""
        raise NotImplementedError

    def inward(self, x: Array) -> Array:
        """(n, 3) unit normals of the face nearest to each point, into the solid."""
        raise NotImplementedError

    def centres(self, count: int, seed: int = 0) -> Array:
        """(count, 3) centres of exact maximal balls that touch random points of the surface."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False)
class Walled(Solid):
    """A solid between walls.

    Parameters
    ----------
    walls : tuple of Wall
    reflex : tuple
        Both ends of each straight reflex edge, and the normals into the solid of its two faces, each (3,).
    """

    walls: tuple[Wall, ...]
    reflex: tuple[tuple[Array, Array, Array, Array], ...] = ()

    def distance(self, x: Array) -> Array:
        return np.min([np.linalg.norm(x - w.feet(x).points, axis=1) for w in self.walls], axis=0)

    def off_axis(self, x: Array) -> Array:
        """The distance from the bisector of the nearest contact and of another one, whichever is least.

        For planes this is exact: the difference of the distances over the length of the difference of their gradients.
        Where an arc is nearest, the axis of its circle counts if the ball there is empty. Convex edges count, too.
        """
        contacts = _Contacts(self.walls, x, self.diagonal)
        off = np.minimum(contacts.off_bisectors(), self._off_focal_lines(x, contacts))
        return np.minimum(off, contacts.off_edges())

    def _off_focal_lines(self, x: Array, contacts: "_Contacts") -> Array:
        focal = np.array([np.inf if w.focal is None else w.focal for w in self.walls])
        focal, rows = focal[contacts.nearest], np.arange(len(x))
        found = np.full(len(x), np.inf)
        chosen = np.flatnonzero(np.isfinite(focal) & ~contacts.clipped[contacts.nearest, rows])
        wall = contacts.nearest[chosen]
        centre = contacts.points[wall, chosen] + focal[chosen, None] * contacts.inward[wall, chosen]
        empty = self.distance(centre) > focal[chosen] - NEAR * self.diagonal
        off = np.linalg.norm(centre - x[chosen], axis=1)
        found[chosen[empty]] = off[empty]
        return found

    def centres(self, count: int, seed: int = 0) -> Array:
        """By bisection along the normal: the ball that touches a point grows until it is no longer empty.

        A twentieth of the points are on each reflex edge, with directions between those of its faces.
        """
        on_edges = [self._edge_points(edge, count // 20, seed) for edge in self.reflex]
        on_faces = self._surface_points(count - len(on_edges) * (count // 20), seed)
        points, inward = map(np.concatenate, zip(on_faces, *on_edges))
        low, high = np.zeros(count), np.full(count, self.diagonal)
        for _ in range(50):
            middle = 0.5 * (low + high)
            reached = self.distance(points + middle[:, None] * inward)
            empty = reached >= middle - 0.1 * TINY * self.diagonal
            low, high = np.where(empty, middle, low), np.where(empty, high, middle)
        return points + low[:, None] * inward

    @staticmethod
    def _edge_points(edge: tuple[Array, ...], count: int, seed: int) -> tuple[Array, Array]:
        """(count, 3) points of a reflex edge and directions between the normals of its faces."""
        start, end, first, second = edge
        t, turn = np.random.default_rng((seed, 1)).random((2, count, 1))
        angle = np.arccos(first @ second)
        inward = np.sin((1 - turn) * angle) * first + np.sin(turn * angle) * second
        return start + t * (end - start), inward / np.sin(angle)

    def _surface_points(self, count: int, seed: int) -> tuple[Array, Array]:
        """(count, 3) points of the exact faces and the normals into the solid."""
        vertices, triangles = self.mesh
        rng = np.random.default_rng(seed)
        near = distance.points_on_triangles(vertices[triangles], count, rng)
        return self._feet(near)

    def _feet(self, x: Array) -> tuple[Array, Array]:
        """(n, 3) the nearest points of the exact faces and the normals into the solid there."""
        feet = [wall.feet(x) for wall in self.walls]
        wall = np.argmin([np.linalg.norm(f.points - x, axis=1) for f in feet], axis=0)
        rows = np.arange(len(x))
        points, inward = (
            np.stack([getattr(f, name) for f in feet])[wall, rows] for name in ("points", "inward")
        )
        return points, inward

    def inward(self, x: Array) -> Array:
        return self._feet(x)[1]


class _Contacts:
    """The feet of points on all walls, and which of them are contacts: nearest points of the surface around them."""

    def __init__(self, of: Sequence[Wall], x: Array, diagonal: float) -> None:
        self.walls, self.x, self.near = of, x, NEAR * diagonal
        feet = [wall.feet(x) for wall in of]
        self.points = np.stack([f.points for f in feet])
        self.inward = np.stack([f.inward for f in feet])
        self.clipped = np.stack([f.clipped for f in feet])
        away = x - self.points
        self.distance = np.linalg.norm(away, axis=2)
        self.nearest = np.argmin(self.distance, axis=0)
        beside = self.clipped & (self.distance > 1e-3 * self.near)
        size = np.where(beside, self.distance, 1.0)[:, :, None]
        self.gradient = np.where(beside[:, :, None], away / size, self.inward)
        self.stand, self.at_edge = self._look_round()

    def off_bisectors(self) -> Array:
        """(n,) Feet from which one sees the point in one direction are one contact."""
        rows = np.arange(self.points.shape[1])
        first, least = self.gradient[self.nearest, rows], self.distance[self.nearest, rows]
        apart = np.linalg.norm(self.gradient - first, axis=2)
        other = self.stand & (apart > SAME)
        off = (self.distance - least) / np.where(other, apart, 1.0)
        return np.where(other, off, np.inf).min(axis=0)

    def off_edges(self) -> Array:
        """(n,) to a convex edge, of points in front of a wall and beyond its border, and of points outside."""
        rows = np.arange(self.points.shape[1])
        height = np.einsum("wij,wij->wi", self.inward, self.x - self.points)
        outside = height[self.nearest, rows] < 0.0
        seen = self.at_edge & (outside | (height > 0.0)) | (self.clipped & outside)
        return np.where(seen, self.distance, np.inf).min(axis=0)

    def _look_round(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """(w, n) each: the surface comes no closer beside the foot; it does, on a wall of another direction.

        Only feet on borders are asked: whether they lie on another wall, too, which has a nearer foot.
        """
        stand, at_edge = np.ones(self.clipped.shape, bool), np.zeros(self.clipped.shape, bool)
        for wall, clipped in enumerate(self.clipped):
            rows = np.flatnonzero(clipped)
            foot, inward = self.points[wall, rows], self.inward[wall, rows]
            for other, surface in enumerate(self.walls):
                there = surface.feet(foot)
                closer = np.linalg.norm(there.points - foot, axis=1) <= self.near
                closer &= np.linalg.norm(self.points[other, rows] - foot, axis=1) > self.near
                stand[wall, rows] &= ~closer
                bent = np.linalg.norm(there.inward - inward, axis=1) > SAME
                at_edge[wall, rows] |= closer & bent
        return stand, at_edge


@dataclass(frozen=True, eq=False)
class Round(Solid):
    """An ellipsoid, whose axis is a disc."""

    shape: Ellipsoid

    def distance(self, x: Array) -> Array:
        return distance.to_ellipsoid(x, tuple(self.shape.semi_axes))

    def off_axis(self, x: Array) -> Array:
        return self.shape.axis_distance(x)

    def inward(self, x: Array) -> Array:
        return -self.shape.normals(x)

    def centres(self, count: int, seed: int = 0) -> Array:
        """The normals meet the plane of the disc there."""
        points = self.shape.candidates(count, np.random.default_rng(seed))
        return points * (1.0 - (self.shape.c / self.shape.semi_axes) ** 2)


def turned(mesh: Mesh, seed: int | None, single: bool = False) -> tuple[Mesh, Array]:
    """The mesh turned at random, or not at all, and rounded to float32; and the (3, 3) frame that turned it."""
    frame = np.eye(3) if seed is None else inputs.rotation(seed)
    points = mesh[0] @ frame.T
    return (points.astype(np.float32).astype(float) if single else points, mesh[1]), frame


# --- prisms

AROUND = 96  # vertices of a circle
RING = 0.12  # height of rings of curved walls


def prism(
    *loops: tuple[Curve, ...],
    half: float,
    area: float | None = None,
    focal: float = 0.0,
    reflex: Sequence[int] = (),
    handles: int = 0,
) -> Walled:
    """A profile moved along z; `focal` is the length of rims at axes of arcs, `reflex` are rows of reflex corners."""
    mesh = _mesh(loops, half)
    rims, upright = _edges(loops, half, reflex)
    length = 2 * sum(curve.length for loop in loops for curve in loop) + focal
    return Walled(
        mesh,
        np.concatenate((rims, *upright)),
        length + 2 * half * len(upright),
        area,
        (1, handles, 0),
        walls.of_prism(loops, half),
        tuple(_reflex_edge(loops[0], row, half) for row in reflex),
    )


def _reflex_edge(loop: Sequence[Curve], row: int, half: float) -> tuple[Array, ...]:
    """The upright edge at the start of a segment, with the normals of both faces; of `Walled.reflex`."""
    at = np.array([loop[row].start])
    normals = [np.append(side.feet(at).inward[0], 0.0) for side in (loop[row - 1], loop[row])]
    ends = [np.append(at[0], z) for z in (-half, half)]
    return (*ends, *normals)


def _edges(
    loops: Sequence[tuple[Curve, ...]], half: float, reflex: Sequence[int]
) -> tuple[Array, list[Array]]:
    """Points of the borders of both faces, and of each upright convex edge."""
    t = np.linspace(0.0, 1.0, 201)
    flat = np.concatenate([curve.at(t) for loop in loops for curve in loop])
    rims = [np.column_stack((flat, np.full(len(flat), z))) for z in (-half, half)]
    sharp = [c.start for i, c in enumerate(loops[0]) if isinstance(c, Segment) and i not in reflex]
    if any(isinstance(curve, Arc) for curve in loops[0]):
        sharp = []  # its arcs are tangent to its segments
    z = half * (2 * t - 1)
    upright = [np.column_stack((np.broadcast_to(at, (len(z), 2)), z)) for at in sharp]
    return np.concatenate(rims), upright


def _mesh(loops: Sequence[tuple[Curve, ...]], half: float) -> Mesh:
    flat = [_points(loop) for loop in loops]
    # Bases of equal length are as long on every processor.
    faces = _cut([np.round(points, 10) for points in flat])
    corners = np.concatenate(flat)
    pieces = [_soup(corners[faces[:, ::-1]], -half), _soup(corners[faces], half)]
    for loop, points in zip(loops, flat):
        rings = int(np.ceil(2 * half / RING)) if any(isinstance(c, Arc) for c in loop) else 1
        pieces += [_strip(points, a, b) for a, b in pairwise(np.linspace(-half, half, rings + 1))]
    soup = np.concatenate(pieces)
    return weld((soup.reshape(-1, 3), np.arange(3 * len(soup), dtype=np.int32).reshape(-1, 3)))


def _points(loop: tuple[Curve, ...]) -> Array:
    """(k, 2) vertices of a loop. A flat face beside an arc is cut as finely, or its smooth surface would bulge."""
    steps = [1 for _ in loop]
    if arcs := [c for c in loop if isinstance(c, Arc)]:
        longest = 2 * np.pi * max(arc.radius for arc in arcs) / AROUND
        steps = [int(np.ceil(c.length / longest * (1 - TINY))) for c in loop]
    return np.concatenate([c.at(np.arange(k) / k) for c, k in zip(loop, steps)])


def _soup(flat: Array, z: float) -> Array:
    """(m, 3, 3) triangles at a height from (m, 3, 2)."""
    return np.concatenate((flat, np.full((*flat.shape[:2], 1), z)), axis=2)


def _strip(points: Array, low: float, high: float) -> Array:
    """(2 k, 3, 3) triangles of a loop's wall between two heights."""
    following = np.roll(points, -1, axis=0)
    a, b, c, d = (
        np.column_stack((p, np.full(len(p), z)))
        for p, z in ((points, low), (following, low), (following, high), (points, high))
    )
    return np.concatenate((np.stack((a, b, c), axis=1), np.stack((a, c, d), axis=1)))


def _cut(loops: Sequence[Array]) -> NDArray[np.intp]:
    """(m, 3) triangles of an outer loop and of at most one hole, by ears with the shortest bases."""
    ring = list(range(len(loops[0])))
    if len(loops) == 2:
        hole = np.arange(len(loops[1])) + len(ring)
        start = int(np.argmin(np.linalg.norm(loops[1] - loops[0][0], axis=1)))
        hole = np.roll(hole, -start).tolist()
        ring = [0, *hole, hole[0], *ring]
        ring = [*ring[: len(hole) + 2], 0, *ring[len(hole) + 3 :]]
    points, triangles = np.concatenate(loops), []
    while len(ring) > 3:
        tip = _best_ear(points[ring])
        triangles.append((ring[tip - 1], ring[tip], ring[(tip + 1) % len(ring)]))
        del ring[tip]
    return np.array([*triangles, ring])


def _best_ear(corners: Array) -> int:
    """The convex corner whose triangle holds no other corner, with the shortest base."""
    before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
    base = np.linalg.norm(after - before, axis=1)
    for tip in np.argsort(base, kind="stable"):
        ear = np.stack((before[tip], corners[tip], after[tip]))
        if _turn(*ear) <= 0.0:
            continue
        inside = np.min([_turn(ear[i], ear[(i + 1) % 3], corners) for i in range(3)], axis=0) >= 0
        at_corner = (corners[:, None] == ear).all(axis=2).any(axis=1)
        if not (inside & ~at_corner).any():
            return int(tip)
    raise ValueError("Expected a simple loop, found one without an ear; look at its corners")


def _turn(a: Array, b: Array, c: Array) -> Array:
    """Twice the area of a, b, c, positive when they turn left."""
    ab, ac = b - a, c - a
    return ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0]


# --- the solids


def _convex_prism(loop: tuple[Segment, ...], half: float) -> Walled:
    planes = [(np.array([0.0, 0.0, z]), half) for z in (-1.0, 1.0)]
    for side in loop:
        outward = -np.append(side.feet(np.zeros((1, 2))).inward[0], 0.0)
        planes.append((outward, float(outward[:2] @ side.start)))
    a, b, c = axis_triangles_of_planes(planes).transpose(1, 0, 2)
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    return prism(loop, half=half, area=area)


def _box() -> Walled:
    x, y, z = SHAPES["box"].half
    return _convex_prism(polygon((-x, -y), (x, -y), (x, y), (-x, y)), z)


def _wedge() -> Walled:
    """A prism over a right triangle with an angle of 30 degrees."""
    return _convex_prism(polygon((0, 0), (2, 0), (2, 2 * np.tan(np.pi / 6))), 0.7)


def _blunt() -> Walled:
    """A house whose roof has a ridge of 145 degrees: the normals are 35 degrees apart."""
    ridge = 0.6 + np.tan(np.radians(17.5))
    return _convex_prism(polygon((-1, 0), (1, 0), (1, 0.6), (0, ridge), (-1, 0.6)), 0.7)


def _fan() -> Walled:
    """A prism with one edge of 135 degrees and three of 75."""
    a = np.radians(75.0)
    d = np.array([np.cos(a), np.sin(a)])
    angle = np.radians([30.0, 105.0])
    along, back = np.column_stack((np.cos(angle), np.sin(angle)))
    t, _ = np.linalg.solve(np.column_stack((along, -back)), np.array([2.0, 0.0]) - d)
    return _convex_prism(polygon((0, 0), (2, 0), tuple(d + t * along), tuple(d)), 0.6)


def _bracket() -> Walled:
    loop = polygon((0, 0), (2, 0), (2, 0.7), (0.7, 0.7), (0.7, 1.6), (0, 1.6))
    return prism(loop, half=0.5, reflex=(3,))


def _profile_t() -> Walled:
    half = [(0.25, 0), (0.25, 1), (0.9, 1), (0.9, 1.5)]
    loop = polygon(*half, *((-x, y) for x, y in reversed(half)))
    return prism(loop, half=0.6, reflex=(1, 6))


def _stairs() -> Walled:
    steps = [(1.8, 0), (1.8, 0.5), (1.2, 0.5), (1.2, 1), (0.6, 1), (0.6, 1.5), (0, 1.5)]
    return prism(polygon((0, 0), *steps), half=0.6, reflex=(3, 5))


def _cylinder() -> Walled:
    shape = MORE_SHAPES["cylinder"]
    radius, half = shape.profile[1][0], shape.profile[2][1]
    made = prism(circle(radius), half=half, area=shape.axis_area)
    return Walled(MESHED["cylinder"][1], made.edges, made.rim, made.area, made.betti, made.walls)


def _cone() -> Walled:
    shape = MORE_SHAPES["cone"]
    radius, half = shape.profile[1][0], shape.profile[2][1]
    rim = circle(radius)[0].at(np.linspace(0.0, 1.0, 801))
    edges = np.column_stack((rim, np.full(len(rim), -half)))
    edges = np.concatenate((edges, [[0.0, 0.0, half]]))
    of = walls.of_cone(radius, half)
    length = 2 * np.pi * radius
    return Walled(MESHED["cone"][1], edges, length, shape.axis_area, (1, 0, 0), of)


def _plate() -> Walled:
    square = polygon((-1, -1), (1, -1), (1, 1), (-1, 1))
    return prism(square, circle(0.4, hole=True), half=0.2, handles=1)


def _stadium() -> Walled:
    """Its axis ends where the axes of the arcs are, as far as the faces do not cut it off."""
    radius, half = 0.5, 0.8
    left = Arc((-1.0, 0.0), radius, np.pi / 2, np.pi)
    right = Arc((1.0, 0.0), radius, -np.pi / 2, np.pi)
    loop = (
        Segment((-1.0, -radius), (1.0, -radius)),
        right,
        Segment((1.0, radius), (-1.0, radius)),
        left,
    )
    return prism(loop, half=half, focal=4 * (half - radius))


def _ellipsoid(name: str) -> Round:
    shape = SHAPES[name]
    p, q = shape.axis_ellipse
    turn = np.linspace(0.0, 2 * np.pi, 200_001)
    curve = np.column_stack((p * np.cos(turn), q * np.sin(turn)))
    rim = float(np.linalg.norm(np.diff(curve, axis=0), axis=1).sum())
    return Round(MESHED[name][1], np.empty((0, 3)), rim, float(np.pi * p * q), shape.betti, shape)


_MAKERS: dict[str, Callable[[], Solid]] = {
    "box": _box,
    "wedge": _wedge,
    "blunt": _blunt,
    "bracket": _bracket,
    "profile": _profile_t,
    "stairs": _stairs,
    "cylinder": _cylinder,
    "cone": _cone,
    "plate": _plate,
    "fan": _fan,
    "stadium": _stadium,
    "oblate": lambda: _ellipsoid("oblate"),
    "ellipsoid": lambda: _ellipsoid("ellipsoid"),
}
NAMES = tuple(_MAKERS)


@cache
def solid(name: str) -> Solid:
    return _MAKERS[name]()
