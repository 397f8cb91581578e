# SPDX-License-Identifier: GPL-3.0-or-later
"""Dey & Zhao's MEDIAL restated by brute force, for a few hundred points. Shares no code with the product.

Coordinates become integers (doubles are dyadic), so circumcentres are exact rationals and every sign, tie and
coincidence is decided exactly. Where a definition leaves a choice (a tie of the farthest Voronoi vertex, a Voronoi
vertex on the tangent plane) the sample is reported in `ambiguous`, and tests compare the others.
"""

from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, pairwise
from math import gcd

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

NEAR = 1e-7  # decisions closer than this (relative) are ambiguous: the product's Voronoi vertices carry 24 bits


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


def unit(vector: NDArray) -> Array:
    """Float unit vector of an integer one of any size."""
    largest = max(abs(int(x)) for x in vector)
    rounded = np.array([int(x) / largest for x in vector])
    return rounded / np.linalg.norm(rounded)


def primitive(vector: NDArray) -> tuple[int, int, int]:
    divisor = gcd(*(int(x) for x in vector))
    return tuple(int(x) // divisor for x in vector)


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


def distinct_rows(points: Array) -> Ints:
    """Rows that repeat no earlier one, ascending."""
    first = {}
    for row, point in enumerate(points):
        first.setdefault(tuple(float(x) + 0.0 for x in point), row)
    return np.array(sorted(first.values()), dtype=np.int64)


def delaunay_qhull(points: Array) -> Ints:
    """(c, 4) corners of the finite cells, each sorted, in lexicographic order; for points in general position."""
    return sort_cells(Delaunay(points, qhull_options="Qbb Qc Qz Q12").simplices)


def delaunay_brute_force(points: Array) -> list[tuple[int, ...]]:
    """All maximal sets of samples on one empty sphere, exact: the Delaunay cells before any is cut up."""
    grid, _ = to_integers(points)
    subsets = np.array(list(combinations(range(len(points)), 4)), dtype=np.int64)
    subsets = subsets[orientation(grid, subsets) != 0]
    on_sphere = [set(subset) for subset in subsets.tolist()]
    alive = np.ones(len(subsets), dtype=bool)
    for query in range(len(points)):
        rows = np.flatnonzero(alive)
        sign = in_sphere(grid, subsets[rows], np.full(len(rows), query))
        alive[rows[sign > 0]] = False
        for row in rows[sign == 0]:
            on_sphere[row].add(query)
    return sorted({tuple(sorted(on_sphere[row])) for row in np.flatnonzero(alive)})


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


# ---- the stages -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Medial:
    """Every quantity of the method for distinct points (k, 3) and Delaunay cells (c, 4) of them."""

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
    def triangles(self) -> dict[tuple[int, int, int], list[tuple[int, int]]]:
        return triangles_of(self.cells)

    @cached_property
    def rays(self) -> dict[tuple[int, int, int], NDArray]:
        """Outward integer normal of each hull triangle: the direction of its Voronoi ray."""
        found = {}
        for corners, sides in self.triangles.items():
            if len(sides) == 1:
                a, b, c = (self.grid[i] for i in corners)
                normal = cross(b - a, c - a)
                found[corners] = -normal if dot(normal, self.grid[sides[0][1]] - a) > 0 else normal
        return found

    @cached_property
    def incident_cells(self) -> list[list[int]]:
        cells = [[] for _ in self.points]
        for cell, corners in enumerate(self.cells.tolist()):
            for sample in corners:
                cells[sample].append(cell)
        return cells

    @cached_property
    def incident_triangles(self) -> list[list[tuple[int, int, int]]]:
        triangles = [[] for _ in self.points]
        for corners in self.triangles:
            for sample in corners:
                triangles[sample].append(corners)
        return triangles

    def infinite_directions(self, sample: int) -> tuple[Array, bool]:
        """Unit directions of the distinct infinite Voronoi edges of a cell, where rays from one vertex along one line
        are one; and whether two of the others lie so close that rounding decides."""
        rays = {}
        for corners in self.incident_triangles[sample]:
            if corners in self.rays:
                cell = self.triangles[corners][0][0]
                key = self.centre_ratios[cell], primitive(self.rays[corners])
                rays[key] = np.concatenate(
                    (unit(self.rays[corners]), self.centres[cell] / self.radius[cell])
                )
        rows = np.array(list(rays.values())).reshape(-1, 6)
        gap = np.abs(rows[:, None] - rows[None]).max(axis=2)[np.triu_indices(len(rows), 1)]
        return rows[:, :3], bool((gap < NEAR).any())

    @cached_property
    def _poles(self) -> tuple[Array, NDArray[np.bool_], list[NDArray], NDArray[np.bool_]]:
        vectors, unbounded, exact, ambiguous = [], [], [], []
        for sample in range(len(self.points)):
            directions, close = self.infinite_directions(sample)
            vector, integer, tie = (
                self._infinite_pole(directions) if len(directions) else self._farthest(sample)
            )
            vectors.append(vector)
            unbounded.append(len(directions) > 0)
            exact.append(integer)
            ambiguous.append(tie or close)
        return np.array(vectors), np.array(unbounded), exact, np.array(ambiguous)

    def _infinite_pole(self, directions: Array) -> tuple[Array, NDArray, bool]:
        mean = directions.mean(axis=0)
        return mean, to_integers(mean[None])[0][0], bool(np.linalg.norm(mean) < NEAR)

    def _farthest(self, sample: int) -> tuple[Array, NDArray, bool]:
        arms = {
            self.centre_ratios[cell]: self._arm(cell, sample)
            for cell in self.incident_cells[sample]
        }
        arms = sorted(arms.values(), key=self._length)
        vector, denominator = arms[-1]
        scale = denominator * self._integers[1]
        tie = len(arms) > 1 and self._length(arms[-2]) >= (1 - NEAR) * self._length(arms[-1])
        return np.array([int(x) / scale for x in vector]), vector, tie

    @property
    def pole_vectors(self) -> Array:
        """(k, 3) Definition 1; for unbounded cells the mean of the unit directions of the distinct infinite edges."""
        return self._poles[0]

    @property
    def unbounded_cells(self) -> NDArray[np.bool_]:
        return self._poles[1]

    @cached_property
    def _umbrellas(self) -> tuple[list[list[tuple[int, int, int]]], NDArray[np.bool_]]:
        chosen, touching = [], self._poles[3].copy()
        for sample in range(len(self.points)):
            pole = self._poles[2][sample]
            height = {
                cell: self._height(self._arm(cell, sample)[0], pole)
                for cell in self.incident_cells[sample]
            }
            touching[sample] |= any(abs(value) < NEAR for value in height.values())
            crossing = []
            for corners in self.incident_triangles[sample]:
                ends = [height[cell] for cell, _ in self.triangles[corners]]
                if len(ends) == 1:
                    ends.append(self._height(self.rays[corners], pole))
                    touching[sample] |= abs(ends[1]) < NEAR
                if ends[0] * ends[1] < 0:
                    crossing.append((sample, *(x for x in corners if x != sample)))
            chosen.append(sorted(crossing))
        return chosen, touching

    def _height(self, vector: NDArray, pole: NDArray) -> float:
        """Sine of the angle between a vector and the plane normal to the pole; its sign is exact."""
        if not any(vector) or not any(pole):
            return 0.0
        product = int(dot(vector, pole))
        squares = int(dot(vector, vector)) * int(dot(pole, pole))
        shift = max(0, squares.bit_length() - 1000) // 2  # floats end at 1024 bits
        ratio = abs(product) // 2**shift / np.sqrt(float(squares // 4**shift))
        return 0.0 if product == 0 else max(ratio, 1e-300) * (1 if product > 0 else -1)

    @property
    def umbrellas(self) -> list[list[tuple[int, int, int]]]:
        """U_p (Definition 3) of each sample: (p, a, b) with a < b whose Voronoi segment or ray crosses the plane."""
        return self._umbrellas[0]

    @property
    def ambiguous(self) -> NDArray[np.bool_]:
        """(k,) samples whose pole or umbrella the definitions do not settle."""
        return self._umbrellas[1]

    @cached_property
    def edges(self) -> Ints:
        """(e, 2) Delaunay edges p < q in lexicographic order."""
        pairs = {
            pair for corners in self.cells.tolist() for pair in combinations(sorted(corners), 2)
        }
        return np.array(sorted(pairs), dtype=np.int64)

    @cached_property
    def _directed(self) -> tuple[Array, Array]:
        """theta and rho of every edge (e, 2): by U_p, by U_q."""
        theta, rho = np.empty(self.edges.shape), np.empty(self.edges.shape)
        normals, largest = self._umbrella_shapes
        for row, (p, q) in enumerate(self.edges):
            vector = self.grid[q] - self.grid[p]
            length, direction = self._length((vector, 1)), unit(vector)
            for end, sample in enumerate((p, q)):
                along = np.abs(normals[sample] @ direction)
                across = np.linalg.norm(np.cross(normals[sample], direction), axis=1)
                theta[row, end] = np.min(np.arctan2(along, across), initial=np.pi / 2)
                rho[row, end] = length / largest[sample] if largest[sample] > 0 else np.inf
        return theta, rho

    @cached_property
    def in_umbrella(self) -> NDArray[np.bool_]:
        """(e, 2) the edge is one of U_p, of U_q: step 5 of MEDIAL tries only the others from that end."""
        links = [{x for triangle in umbrella for x in triangle[1:]} for umbrella in self.umbrellas]
        return np.array([[q in links[p], p in links[q]] for p, q in self.edges.tolist()])

    @cached_property
    def _umbrella_shapes(self) -> tuple[list[Array], Array]:
        """Unit normals of each umbrella's triangles and its largest circumradius."""
        normals, largest = [], np.zeros(len(self.points))
        for sample, umbrella in enumerate(self.umbrellas):
            rows = []
            for p, a, b in umbrella:
                u, v = self.grid[a] - self.grid[p], self.grid[b] - self.grid[p]
                normal = cross(u, v)
                rows.append(unit(normal))
                sines = self._sine(u, v, normal)
                largest[sample] = max(largest[sample], self._length((u - v, 1)) / (2 * sines))
            normals.append(np.array(rows).reshape(-1, 3))
        return normals, largest

    def _sine(self, u: NDArray, v: NDArray, normal: NDArray) -> float:
        square, product = int(dot(normal, normal)), int(dot(u, u)) * int(dot(v, v))
        return float(np.sqrt(square / product))

    @property
    def theta(self) -> Array:
        return self._directed[0].max(axis=1)

    @property
    def rho(self) -> Array:
        return self._directed[1].max(axis=1)

    @property
    def theta_both(self) -> Array:
        return self._directed[0].min(axis=1)

    @property
    def rho_both(self) -> Array:
        return self._directed[1].min(axis=1)

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
        outer = {pair for corners in self.rays for pair in combinations(corners, 2)}
        return np.array([tuple(edge) not in outer for edge in self.edges.tolist()])

    @cached_property
    def length(self) -> Array:
        return np.array([self._length((self.grid[q] - self.grid[p], 1)) for p, q in self.edges])

    def facet(self, edge: int) -> Array:
        """(m, 3) distinct Voronoi vertices of the facet dual to an edge; fewer than 3 when it has no area."""
        distinct = {self.centre_ratios[cell]: cell for cell in self.rings[edge]}
        return self.centres[sorted(distinct.values())]

    def selected(
        self, theta0: float, rho0: float, rule: str, criteria: str, limit_set: bool
    ) -> NDArray[np.bool_]:
        """(e,) Angle[theta0] or Ratio[rho0], by one end or by both; from p only edges that are not in U_p."""
        either = np.max if rule == "EITHER" else np.min
        theta, rho = (either(np.where(self.in_umbrella, 0.0, x), axis=1) for x in self._directed)
        angle = (theta > theta0) & (criteria != "RATIO")
        ratio = (rho > rho0) & (criteria != "ANGLE")
        if limit_set:
            mu = np.array([self.radius[ring].min() for ring in self.rings])
            eps = self.length / (np.maximum(rho, np.finfo(float).tiny) * mu)
            ratio &= self.length >= eps**0.25 * mu
        return angle | ratio

    def side(self, vertices: Array, triangles: Ints) -> Ints:
        """(e,) 1 inner: all Voronoi vertices have winding number > 1/2; 2 outer: none; 3: some. Infinity has 0."""
        inside = winding_number(self.centres, vertices, triangles) > 0.5
        sides = []
        for edge, ring in enumerate(self.rings):
            every = inside[ring].all() and self.bounded[edge]
            sides.append(1 if every else 3 if inside[ring].any() else 2)
        return np.array(sides)


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


def boundary_edges(triangles: Ints) -> int:
    """Edges that are not used equally often in both directions."""
    balance = defaultdict(int)
    for corners in np.asarray(triangles).tolist():
        for a, b in zip(corners, corners[1:] + corners[:1]):
            balance[min(a, b), max(a, b)] += 1 if a < b else -1 if a > b else 0
    return sum(1 for value in balance.values() if value)


def betti_numbers(offsets: Ints, corners: Ints) -> tuple[int, int, int]:
    """(b0, b1, b2) over GF(2) of the cell complex of polygons, by collapses and then column reduction."""
    faces = [corners[a:b].tolist() for a, b in pairwise(offsets)]
    edge_row, boundary = {}, []
    for face in faces:
        pairs = [(min(a, b), max(a, b)) for a, b in zip(face, face[1:] + face[:1])]
        boundary.append({edge_row.setdefault(pair, len(edge_row)) for pair in pairs})
    points = sorted({int(x) for x in corners})
    b0 = _components(points, edge_row)
    b2 = _kernel(_collapse(boundary))
    euler = len(points) - len(edge_row) + len(faces)
    return b0, b0 + b2 - euler, b2


def _components(points: list[int], edges: dict) -> int:
    parent = {x: x for x in points}

    def root(x: int) -> int:
        while parent[x] != x:
            parent[x] = parent[parent[x]]
            x = parent[x]
        return x

    for a, b in edges:
        parent[root(a)] = root(b)
    return len({root(x) for x in points})


def _collapse(boundary: list[set[int]]) -> list[set[int]]:
    """Faces that are left when faces with an edge of their own are taken away until there is none."""
    users = defaultdict(set)
    for face, edges in enumerate(boundary):
        for edge in edges:
            users[edge].add(face)
    waiting = [edge for edge, faces in users.items() if len(faces) == 1]
    while waiting:
        edge = waiting.pop()
        if len(users[edge]) != 1:
            continue
        (face,) = users[edge]
        for other in boundary[face]:
            users[other].discard(face)
            if len(users[other]) == 1:
                waiting.append(other)
    return [boundary[face] for face in sorted(set().union(*users.values()))]


def _kernel(boundary: list[set[int]]) -> int:
    """Dimension of the kernel over GF(2) of the matrix whose columns are sets of rows."""
    pivots, cycles = {}, 0
    for column in boundary:
        column = set(column)
        while column and max(column) in pivots:
            column ^= pivots[max(column)]
        if column:
            pivots[max(column)] = column
        else:
            cycles += 1
    return cycles
