# SPDX-License-Identifier: GPL-3.0-or-later
"""The methods that the paper compares itself with, on the Voronoi diagram that is ours, as programs of the race.

All but the shrinking ball are in the module _medial_study, too; what is restated here, with NumPy, is what its tests
compare with.

    python3 -m lab.race.rivals METHOD INPUT OUTPUT.off [--side OUTER] [option=value ...]

INPUT is .xyz or .xyzn. Inside is what Tight Cocone says.

poles            the farthest Voronoi vertices of the cells, on either side (Amenta & Bern 1998; Boissonnat &
                 Cazals 2001)
power-shape      where power cells of inner poles meet (Amenta, Choi & Kolluri 2001)
angle-length     facets whose balls see pq under an angle at least `angle` degrees, with |pq| at least `length`
                 diagonals (after Attali & Lachaud 2001)
lambda           facets and edges whose nearest samples fit in no ball smaller than `radius` diagonals (Chazal &
                 Lieutier 2005)
pole-normal      MEDIAL with the pole vector in place of the normals of the umbrella (the paper's Remark)
polygon-width    MEDIAL with the reach of the tangent polygon in place of the circumradii of the umbrella (the same)
pole-and-width   both
shrinking-ball   balls that shrink until they are empty, from given normals (Ma, Bae & Choi 2012)
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from . import product

medial = product.study()

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

THETA, RHO = np.pi / 8, 8.0


@dataclass(frozen=True)
class Found:
    """(v, 3) vertices, polygons as offsets and corners, and (e, 2) edges without a polygon."""

    vertices: Array
    offsets: Ints
    corners: Ints
    edges: Ints


class Samples:
    """Points and what their Voronoi diagram says of one side."""

    def __init__(self, points: Array, normals: Array | None = None, outer: bool = False) -> None:
        self.points, self.normals = points, normals
        self.side = medial.Side.OUTER if outer else medial.Side.INNER

    @property
    def diagonal(self) -> float:
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))

    @cached_property
    def facets(self):
        """All Voronoi facets of the side: no pq is shorter than 0."""
        analysis = medial.MedialAnalysis(self.points, sides=medial.SidesFrom.TIGHT_COCONE)
        return medial.axis_by_size(analysis, medial.SizeCondition.LAMBDA, 0.0, side=self.side)

    @cached_property
    def lengths(self) -> Array:
        """(f,) |pq| of each facet."""
        p, q = self.points[self.facets.generators].transpose(1, 0, 2)
        return np.linalg.norm(p - q, axis=1)

    @cached_property
    def cells(self) -> tuple[Ints, Array, Array, Flags]:
        """Finite Delaunay cells: (c, 4) samples, (c, 3) circumcentres, (c,) radii, and which lie on the side."""
        cells, _, centres = medial.delaunay(self.points)
        finite = (cells >= 0).all(axis=1)
        cells, centres = cells[finite].astype(np.int64), centres[finite]
        sides = medial.TightCocone(self.points).cell_side[finite]
        radii = np.linalg.norm(self.points[cells[:, 0]] - centres, axis=1)
        return cells, centres, radii, sides == self.side.value

    def kept(self, facets: Flags, edges: Ints | None = None) -> Found:
        mesh, sizes = self.facets, np.diff(self.facets.face_offsets)
        return _used(
            mesh.vertices,
            np.concatenate(([0], np.cumsum(sizes[facets]))),
            mesh.face_vertices[np.repeat(facets, sizes)].astype(np.int64),
            np.empty((0, 2), np.int64) if edges is None else edges,
        )


def _used(vertices: Array, offsets: Ints, corners: Ints, edges: Ints) -> Found:
    """Without vertices that nothing uses."""
    rows, place = np.unique(np.concatenate((corners, edges.ravel())), return_inverse=True)
    place = place.reshape(-1)
    return Found(
        vertices[rows], offsets, place[: len(corners)], place[len(corners) :].reshape(-1, 2)
    )


# --- poles


def pole_cells(samples: Samples) -> Ints:
    """Finite cells, ascending, whose Voronoi vertex is p+ or p- of a sample: the farthest of its cell, and the farthest
    against it. On the hull p+ is at infinity."""
    cells, centres, radii, _ = samples.cells
    vectors, unbounded = medial.poles(samples.points)
    owner, cell = cells.ravel(), np.repeat(np.arange(len(cells)), 4)
    along = np.einsum("ij,ij->i", centres[cell] - samples.points[owner], vectors[owner])
    found = []
    for chosen in ((along > 0.0) & ~unbounded[owner], along < 0.0):
        rows = np.flatnonzero(chosen)
        order = rows[np.lexsort((radii[cell[rows]], owner[rows]))]
        last = np.diff(owner[order], append=-1) != 0
        found.append(cell[order[last]])
    return np.unique(np.concatenate(found))


def poles(samples: Samples) -> Found:
    _, centres, _, there = samples.cells
    rows = pole_cells(samples)
    return _points(centres[rows[there[rows]]])


def _points(places: Array) -> Found:
    nothing = np.empty(0, np.int64)
    return Found(places, np.zeros(1, np.int64), nothing, nothing.reshape(0, 2))


def polar_balls(samples: Samples) -> Array:
    """(k, 5) centre and radius of every pole, and 1 where it is on the side. With the corners of a box five times as
    large among the points, as in the paper: so every sample has an outer pole."""
    low, high = samples.points.min(axis=0), samples.points.max(axis=0)
    unit = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    points = np.concatenate((samples.points, (low + high) / 2 + 2.5 * unit * (high - low)))
    boxed = Samples(points, None, samples.side == medial.Side.OUTER)
    _, centres, radii, there = boxed.cells
    rows = pole_cells(boxed)
    return np.column_stack((centres[rows], radii[rows], there[rows]))


def power_shape(samples: Samples) -> Found:
    balls = polar_balls(samples)
    centres, radii = np.ascontiguousarray(balls[:, :3]), np.ascontiguousarray(balls[:, 3])
    rows, triangles, edges = medial.power_shape(centres, radii, balls[:, 4] == 1.0)
    place = np.full(len(balls), -1)
    place[rows] = np.arange(len(rows))
    offsets = np.arange(0, 3 * len(triangles) + 1, 3)
    return Found(centres[rows], offsets, place[triangles].ravel(), place[edges])


# --- facets by other conditions


def angle_length(samples: Samples, angle: float = 45.0, length: float = 0.05) -> Found:
    """At every vertex of the facet; the angle is the least where the ball is the largest."""
    mesh = samples.facets
    largest = np.maximum.reduceat(mesh.radius[mesh.face_vertices], mesh.face_offsets[:-1])
    seen = 2 * np.arcsin(np.minimum(samples.lengths / (2 * largest), 1.0))
    far = samples.lengths >= length * samples.diagonal
    return samples.kept((seen >= np.radians(angle)) & far)


def lambda_axis(samples: Samples, radius: float = 0.025) -> Found:
    """A facet where |pq| / 2 is at least lambda, an edge where the smallest ball round the corners of its Delaunay
    triangle is as large; vertices are those of edges."""
    wanted, mesh = radius * samples.diagonal, samples.facets
    facets = samples.lengths >= 2 * wanted
    edges, of_corner = medial.polygon_edges(
        mesh.face_offsets, mesh.face_vertices, len(mesh.vertices)
    )
    face = np.repeat(np.arange(len(facets)), np.diff(mesh.face_offsets))
    order = np.argsort(of_corner, kind="stable")
    whole = np.bincount(of_corner, minlength=len(edges)) == 3
    rows = face[order[whole[of_corner[order]]]].reshape(-1, 3)
    ball = _smallest_ball(np.sort(samples.lengths[rows], axis=1))
    loose = (ball >= wanted) & ~facets[rows].any(axis=1)
    return samples.kept(facets, edges[whole][loose].astype(np.int64))


def _smallest_ball(sides: Array) -> Array:
    """(n,) radius of the smallest ball round triangles with ascending sides a <= b <= c."""
    a, b, c = sides.T
    area = np.sqrt(np.maximum((a + b + c) * (b + c - a) * (a + c - b) * (a + b - c), 0.0)) / 4
    round_all = a * b * c / np.maximum(4 * area, np.finfo(float).tiny)
    return np.where(a * a + b * b <= c * c, c / 2, round_all)


def variant(samples: Samples, by_pole: bool, by_polygon: bool) -> Found:
    """MEDIAL with its rule Either; what is not asked for is as in the paper."""
    points, pairs = samples.points, samples.facets.generators
    vectors, _ = medial.poles(points)
    passed = np.zeros(len(pairs), bool)
    for p, q in (pairs.T, pairs.T[::-1]):
        along = points[q] - points[p]
        if by_pole:
            across = np.abs(np.einsum("ij,ij->i", along, vectors[p]))
            size = np.linalg.norm(vectors, axis=1)[p] * samples.lengths
            passed |= across > np.sin(THETA) * size
        if by_polygon:
            passed |= samples.lengths > RHO * polygon_reach(points, vectors)[p]
    if not by_pole:
        passed |= samples.facets.theta > THETA
    if not by_polygon:
        passed |= samples.facets.rho > RHO
    return samples.kept(passed)


def polygon_reach(points: Array, vectors: Array) -> Array:
    """(n,) distance of the farthest corner of the tangent polygon of each sample: where the line that is dual to a
    triangle of the umbrella meets the plane through p with the pole vector as normal."""
    offsets, triangles = medial.umbrellas(points)
    p = triangles[:, 0]
    a, b = (points[triangles[:, k]] - points[p] for k in (1, 2))
    normal = np.cross(a, b)
    square = np.einsum("ij,ij->i", normal, normal)[:, None]
    middle = (np.sum(a * a, 1)[:, None] * np.cross(b, normal)) + (
        np.sum(b * b, 1)[:, None] * np.cross(normal, a)
    )
    middle /= 2 * square
    slope = np.einsum("ij,ij->i", normal, vectors[p])
    step = -np.einsum("ij,ij->i", middle, vectors[p]) / slope
    corner = np.linalg.norm(middle + step[:, None] * normal, axis=1)
    return np.maximum.reduceat(corner, offsets[:-1])


# --- balls from normals


def shrinking_ball(samples: Samples, steps: int = 60) -> Found:
    """From a ball as large as the diagonal; the sample that is nearest to its centre makes it smaller."""
    if samples.normals is None:
        raise SystemExit("Expected normals, found none; give a file .xyzn")
    points, inward = samples.points, -samples.normals
    if samples.side == medial.Side.OUTER:
        inward = -inward
    tree, radius = cKDTree(points), np.full(len(points), samples.diagonal)
    going = np.arange(len(points))
    for _ in range(steps):
        centre = points[going] + radius[going, None] * inward[going]
        gap, nearest = tree.query(centre)
        inside = gap < radius[going] * (1 - 1e-9)
        going, nearest = going[inside], nearest[inside]
        if len(going) == 0:
            break
        away = points[nearest] - points[going]
        height = np.einsum("ij,ij->i", away, inward[going])
        radius[going] = np.einsum("ij,ij->i", away, away) / (2 * height)
    return _points(points + radius[:, None] * inward)


# --- a program


def write_off(found: Found, path: Path) -> None:
    polygons = np.split(found.corners, found.offsets[1:-1]) if len(found.offsets) > 1 else []
    lines = ["OFF", f"{len(found.vertices)} {len(polygons) + len(found.edges)} 0"]
    lines += [f"{x:.17g} {y:.17g} {z:.17g}" for x, y, z in found.vertices.tolist()]
    lines += [f"{len(row)} {' '.join(map(str, row.tolist()))}" for row in polygons]
    lines += [f"2 {p} {q}" for p, q in found.edges.tolist()]
    path.write_text("\n".join(lines) + "\n")


METHODS = {
    "poles": poles,
    "power-shape": power_shape,
    "angle-length": angle_length,
    "lambda": lambda_axis,
    "pole-normal": lambda samples: variant(samples, True, False),
    "polygon-width": lambda samples: variant(samples, False, True),
    "pole-and-width": lambda samples: variant(samples, True, True),
    "shrinking-ball": shrinking_ball,
}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("method", choices=METHODS)
    parser.add_argument("input", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("options", nargs="*", metavar="option=value")
    parser.add_argument("--side", choices=("INNER", "OUTER"), default="INNER")
    given = parser.parse_args()
    rows = np.loadtxt(given.input, ndmin=2)
    normals = np.ascontiguousarray(rows[:, 3:6]) if rows.shape[1] > 3 else None
    samples = Samples(np.ascontiguousarray(rows[:, :3]), normals, given.side == "OUTER")
    options = {name: float(x) for name, x in (word.split("=") for word in given.options)}
    write_off(METHODS[given.method](samples, **options), given.output)


if __name__ == "__main__":
    main()
