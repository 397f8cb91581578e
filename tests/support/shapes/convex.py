# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids with sharp edges: a box, and what a convex profile turned round the z axis encloses."""

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from support import distance

from .base import Array, Rng, Shape, shares


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
        return axis_triangles_of_planes(planes)

    def axis_distance(self, x: Array) -> Array:
        return np.min([distance.to_triangle(x, t) for t in self.axis_triangles()], axis=0)

    def axis_points(self, count: int, seed: int = 0) -> Array:
        return distance.points_on_triangles(
            self.axis_triangles(), count, np.random.default_rng(seed)
        )


def axis_triangles_of_planes(planes: list[tuple[Array, float]]) -> Array:
    """(m, 3, 3): the axis of a convex polytope, cut into triangles. Planes are n . x <= d with unit n."""
    triangles = []
    for first, second in combinations(planes, 2):
        others = [plane for plane in planes if plane is not first and plane is not second]
        triangles += _fan(_bisector(*first, *second, others))
    return np.array(triangles)


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
class Lathe(Shape):
    """A convex profile (rho, z), upward from the z axis back to it, turned round that axis.

    Nearest points lie in the same half plane, or all round for a point of the z axis. So the medial axis is that of
    the profile and its mirror image, a convex polygon, turned: for each pair of its edges the segment where both are
    nearest becomes a cone, a disc, or stays a segment of the z axis. A cylinder or a frustum has the bisector of each
    rim's angle, turned, up to the z axis and the segment between the two apices; or, when it is flat, up to the
    disc or cone that is halfway between the ends.
    """

    profile: tuple[tuple[float, float], ...]
    betti = (1, 0, 0)

    @cached_property
    def edges(self) -> Array:
        """(k, 2, 2) ends of the profile's edges."""
        corners = np.array(self.profile)
        edges = np.stack((corners[:-1], corners[1:]), axis=1)
        return edges[np.any(edges[:, 0] != edges[:, 1], axis=1)]

    @cached_property
    def _lines(self) -> tuple[Array, Array]:
        """Outward unit normals n and offsets d of the edges: n . x <= d inside."""
        along = self.edges[:, 1] - self.edges[:, 0]
        normals = np.column_stack((along[:, 1], -along[:, 0]))
        normals /= np.linalg.norm(along, axis=1)[:, None]
        return normals, np.einsum("ij,ij->i", normals, self.edges[:, 0])

    @cached_property
    def axis_segments(self) -> Array:
        """(m, 2, 2) the axis in the half plane rho >= 0."""
        lines = [(n, d) for n, d in zip(*self._lines)]
        lines += [(n * (-1, 1), d) for n, d in lines if n[0] != 0.0]
        found = [_bisecting_segment(lines, *pair) for pair in combinations(range(len(lines)), 2)]
        return np.array([segment for segment in found if segment is not None])

    @cached_property
    def axis_area(self) -> float:
        """The area of the cones and discs that the segments of the profile's axis become."""
        lengths, radii = _lengths(self.axis_segments), self.axis_segments[:, :, 0].sum(axis=1)
        return float(np.pi * (radii * lengths).sum())

    @cached_property
    def _areas(self) -> Array:
        return np.pi * self.edges[:, :, 0].sum(axis=1) * _lengths(self.edges)

    @cached_property
    def area(self) -> float:
        return float(self._areas.sum())

    def candidates(self, count: int, rng: Rng) -> Array:
        return rng.permutation(_turned(self.edges, shares(count, self._areas, rng), rng))

    def field(self, x: Array) -> Array:
        normals, offsets = self._lines
        return np.max(_half_plane(x) @ normals.T - offsets, axis=1)

    def axis_distance(self, x: Array) -> Array:
        flat = _half_plane(x)
        return np.min([distance.to_segment(flat, a, b) for a, b in self.axis_segments], axis=0)

    def axis_points(self, count: int, seed: int = 0) -> Array:
        """Uniform on each sheet; sheets and the segment of the z axis share them by their lengths in the half plane."""
        rng = np.random.default_rng(seed)
        return _turned(self.axis_segments, shares(count, _lengths(self.axis_segments), rng), rng)


def cylinder(radius: float, half: float) -> Lathe:
    return frustum(radius, radius, half)


def frustum(bottom: float, top: float, half: float) -> Lathe:
    """Radii of the two ends at z = -half and z = half; a cone when `top` is 0."""
    return Lathe(((0.0, -half), (bottom, -half), (top, half), (0.0, half)))


def _half_plane(x: Array) -> Array:
    return np.column_stack((np.hypot(x[:, 0], x[:, 1]), x[:, 2]))


def _lengths(segments: Array) -> Array:
    return np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)


def _turned(segments: Array, counts: Array, rng: Rng) -> Array:
    """Points of the surfaces that the segments become when they are turned, counts[i] uniform ones of the i-th."""
    start, end = np.repeat(segments, counts, axis=0).transpose(1, 0, 2)
    u, turn = rng.random((2, len(start)))
    near, far = start[:, 0], end[:, 0]
    rho = np.sqrt(near**2 + u * (far**2 - near**2))
    level = near == far
    t = np.where(level, u, (rho - near) / np.where(level, 1.0, far - near))
    z = start[:, 1] + t * (end[:, 1] - start[:, 1])
    turn *= 2 * np.pi
    return np.column_stack((rho * np.cos(turn), rho * np.sin(turn), z))


def _bisecting_segment(lines: list, first: int, second: int) -> Array | None:
    """The points with rho >= 0 that are as far from one line as from the other and no farther from any other."""
    (n, d), (m, e) = lines[first], lines[second]
    normal, gap = n - m, d - e
    size = np.linalg.norm(normal)
    along = np.array([-normal[1], normal[0]]) / size
    foot = normal * gap / size**2
    limits = [(k - n, f - d) for i, (k, f) in enumerate(lines) if i not in (first, second)]
    low, high = -np.inf, np.inf
    for k, f in [*limits, (n, d), (np.array([-1.0, 0.0]), 0.0)]:
        slope, room = k @ along, f - k @ foot
        if abs(slope) < 1e-12:
            if room < -1e-12:
                return None
        elif slope > 0.0:
            high = min(high, room / slope)
        else:
            low = max(low, room / slope)
    if high - low < 1e-12:
        return None
    return np.maximum(np.array([foot + low * along, foot + high * along]), (0.0, -np.inf))


def grid_cube(cells: int = 8) -> Array:
    """The surface points of a cubic grid of cells^3 unit cubes, centred: half size cells / 2.

    Its inner facets are known: on each of the 12 triangles of the cube's axis 1 + 3 + ... + (cells - 1) for even cells.
    """
    axis = np.arange(cells + 1) - cells / 2
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    return points[np.abs(points).max(axis=1) == cells / 2]
