# SPDX-License-Identifier: GPL-3.0-or-later
"""Delaunay and Voronoi by exact integers, winding and Betti numbers by brute force, for a few hundred points.

It shares no code with the product. Coordinates become integers (doubles are dyadic), so circumcentres are exact
rationals. `tests/native/oracle.h` restates the rest of MEDIAL in the same way.
"""

from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from math import gcd

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


# ---- exact integers -------------------------------------------------------------------------------------------


def to_integers(points: Array) -> tuple[NDArray, int]:
    """Points times a power of two, as an object array of Python integers, and that power."""
    ratios = [[float(x).as_integer_ratio() for x in row] for row in points]
    scale = max((ratio[1] for row in ratios for ratio in row), default=1)
    return np.array([[a * (scale // b) for a, b in row] for row in ratios], dtype=object).reshape(
        -1, 3
    ), scale


def cross(a: NDArray, b: NDArray) -> NDArray:
    """Cross product of object arrays (..., 3)."""
    result = np.empty(a.shape, dtype=object)  # never int64, which would overflow
    for axis, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        result[..., axis] = a[..., i] * b[..., j] - a[..., j] * b[..., i]
    return result


def dot(a: NDArray, b: NDArray) -> NDArray:
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]


def orientation(grid: NDArray, cells: Ints) -> NDArray:
    """6 x volume of each cell, exact."""
    a, b, c = (grid[cells[:, i]] - grid[cells[:, 0]] for i in (1, 2, 3))
    return dot(a, cross(b, c))


def in_sphere(grid: NDArray, cells: Ints, queries: Ints) -> NDArray:
    """Exact sign of each query against the sphere of its cell: > 0 strictly inside, 0 on it. Any cell orientation."""
    a, b, c, e = (
        grid[ids] - grid[cells[:, 0]] for ids in (cells[:, 1], cells[:, 2], cells[:, 3], queries)
    )
    lift = lambda v: dot(v, v)
    volume = dot(a, cross(b, c))
    lifted = (
        lift(a) * dot(e, cross(b, c))
        + lift(b) * dot(e, cross(c, a))
        + lift(c) * dot(e, cross(a, b))
    )
    value = (lifted - lift(e) * volume) * np.where(volume > 0, 1, -1)
    return np.sign(value).astype(int)


# ---- Delaunay -------------------------------------------------------------------------------------------------


def sort_cells(cells: Ints) -> Ints:
    cells = np.sort(cells, axis=1).astype(np.int64)
    return cells[np.lexsort(cells.T[::-1])]


def assert_delaunay(points: Array, cells: Ints) -> None:
    """Exact proof that cells (c, 4) are a Delaunay triangulation of the points: every cell has volume, every inner
    triangle is locally Delaunay, every outer one lies on the hull, and all samples are corners."""
    grid, _ = to_integers(points)
    assert np.array_equal(np.unique(cells), np.arange(len(points))), "some sample is no corner"
    assert np.all(orientation(grid, cells) != 0), "a cell has no volume"
    for corners, sides in triangles_of(cells).items():
        assert len(sides) <= 2, "three cells share a triangle"
        if len(sides) == 2:
            (first, apex), (_, other) = sides
            assert in_sphere(grid, cells[[first]], np.array([other]))[0] <= 0, (
                "a sphere is not empty"
            )
            assert _beyond(grid, corners, apex, np.array([other]))[0] > 0, "two cells overlap"
        else:
            assert np.all(_beyond(grid, corners, sides[0][1], np.arange(len(points))) <= 0), (
                "the hull is not convex"
            )


def triangles_of(cells: Ints) -> dict[tuple[int, int, int], list[tuple[int, int]]]:
    """Sorted corners -> the one or two (cell, opposite corner)."""
    triangles = defaultdict(list)
    for cell, corners in enumerate(cells.tolist()):
        for apex in corners:
            triangles[tuple(sorted(x for x in corners if x != apex))].append((cell, apex))
    return dict(triangles)


def _beyond(grid: NDArray, corners: tuple[int, int, int], apex: int, queries: Ints) -> NDArray:
    """+1 where a query lies on the other side of a triangle than its apex, 0 on its plane."""
    a, b, c = (grid[i] for i in corners)
    normal = cross(b - a, c - a)
    side = 1 if dot(normal, grid[apex] - a) > 0 else -1
    return -side * np.sign(dot(grid[queries] - a, normal)).astype(int)


# ---- Voronoi --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Voronoi:
    """The diagram of distinct points (k, 3) by Delaunay cells (c, 4) of them."""

    points: Array
    cells: Ints

    @cached_property
    def _integers(self) -> tuple[NDArray, int]:
        return to_integers(self.points)

    @property
    def grid(self) -> NDArray:
        return self._integers[0]

    @cached_property
    def centre_ratios(self) -> list[tuple[int, int, int, int]]:
        """Circumcentres in grid units as reduced (x, y, z, denominator > 0); equal exactly when they coincide."""
        p = self.grid[self.cells[:, 0]]
        a, b, c = (self.grid[self.cells[:, i]] - p for i in (1, 2, 3))
        bc, ca, ab = cross(b, c), cross(c, a), cross(a, b)
        volume = 2 * dot(a, bc)
        offset = dot(a, a)[:, None] * bc + dot(b, b)[:, None] * ca + dot(c, c)[:, None] * ab
        ratios = []
        for numerator, denominator in zip(volume[:, None] * p + offset, volume):
            divisor = gcd(*(int(x) for x in numerator), int(denominator)) * (
                1 if denominator > 0 else -1
            )
            ratios.append(tuple(int(x) // divisor for x in (*numerator, denominator)))
        return ratios

    @cached_property
    def centres(self) -> Array:
        """(c, 3) Voronoi vertices, rounded once."""
        scale = self._integers[1]
        return np.array(
            [
                [x / (d * scale), y / (d * scale), z / (d * scale)]
                for x, y, z, d in self.centre_ratios
            ]
        )

    @cached_property
    def radius(self) -> Array:
        """(c,) distance of each Voronoi vertex to its samples."""
        return np.array(
            [self._length(self._arm(cell, corners[0])) for cell, corners in enumerate(self.cells)]
        )

    def _arm(self, cell: int, sample: int) -> tuple[NDArray, int]:
        """Vector from a sample to a Voronoi vertex: integer numerator and positive denominator."""
        *numerator, denominator = self.centre_ratios[cell]
        return np.array(numerator, dtype=object) - denominator * self.grid[sample], denominator

    def _length(self, arm: tuple[NDArray, int]) -> float:
        vector, denominator = arm
        largest = max((abs(int(x)) for x in vector), default=0)
        if largest == 0:
            return 0.0
        norm = np.linalg.norm([int(x) / largest for x in vector])
        return float(norm * (largest / (denominator * self._integers[1])))

    @cached_property
    def edges(self) -> Ints:
        """(e, 2) Delaunay edges p < q in lexicographic order."""
        pairs = {
            pair for corners in self.cells.tolist() for pair in combinations(sorted(corners), 2)
        }
        return np.array(sorted(pairs), dtype=np.int64)

    @cached_property
    def rings(self) -> list[list[int]]:
        """Finite cells round each edge, in no order."""
        row = {tuple(edge): i for i, edge in enumerate(self.edges.tolist())}
        rings = [[] for _ in self.edges]
        for cell, corners in enumerate(self.cells.tolist()):
            for pair in combinations(sorted(corners), 2):
                rings[row[pair]].append(cell)
        return rings

    @cached_property
    def bounded(self) -> NDArray[np.bool_]:
        """(e,) the dual facet does not reach infinity: no hull triangle has the edge."""
        hull = [corners for corners, sides in triangles_of(self.cells).items() if len(sides) == 1]
        outer = {pair for corners in hull for pair in combinations(corners, 2)}
        return np.array([tuple(edge) not in outer for edge in self.edges.tolist()])

    def facet(self, edge: int) -> Array:
        """(m, 3) distinct Voronoi vertices of the facet dual to an edge; fewer than 3 when it has no area."""
        distinct = {self.centre_ratios[cell]: cell for cell in self.rings[edge]}
        return self.centres[sorted(distinct.values())]


def winding_number(queries: Array, vertices: Array, triangles: Ints) -> Array:
    """(q,) sum of the signed solid angles of all triangles over 4 pi (van Oosterom & Strackee 1983)."""
    total = np.zeros(len(queries))
    for corner in vertices[triangles]:
        a, b, c = (x - queries for x in corner)
        la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c))
        ab, bc, ca = (np.einsum("ij,ij->i", x, y) for x, y in ((a, b), (b, c), (c, a)))
        total += 2.0 * np.arctan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb)
    return total / (4.0 * np.pi)


def betti_numbers(vertices: int, polygons: list, wires: list = ()) -> tuple[int, int, int]:
    """(b0, b1, b2) over GF(2) of a complex of so many vertices, of polygons, and of edges besides theirs."""
    number, edges_of = {}, []
    for face in polygons:
        pairs = {(min(a, b), max(a, b)) for a, b in zip(face, face[1:] + face[:1])}
        edges_of.append(sum(1 << number.setdefault(pair, len(number)) for pair in pairs))
    for a, b in wires:
        number.setdefault((min(a, b), max(a, b)), len(number))
    r1, r2 = rank([1 << a | 1 << b for a, b in number]), rank(edges_of)
    return vertices - r1, len(number) - r1 - r2, len(edges_of) - r2


def rank(rows: list[int]) -> int:
    """The rank over GF(2) of a matrix whose rows are the bits of integers."""
    pivots: dict[int, int] = {}
    for row in rows:
        while row:
            high = row.bit_length()
            if high not in pivots:
                pivots[high] = row
                break
            row ^= pivots[high]
    return len(pivots)
