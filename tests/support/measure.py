# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances between a computed medial axis and the exact one of a shape. Used by the tests and the benchmarks."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import distance
from .shapes import Shape

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Errors:
    """o->t: from area-weighted points of the output to the true axis; t->o: from the true axis to the output,
    the mean over uniform points and the maximum over points of its border too."""

    output_mean: float
    output_p99: float
    output_max: float
    truth_mean: float
    truth_max: float

    def row(self) -> list[float]:
        return [self.output_mean, self.output_p99, self.output_max, self.truth_mean, self.truth_max]


def polygons(mesh) -> list[NDArray[np.int32]]:
    return np.split(mesh.face_vertices, mesh.face_offsets[1:-1])


def following(mesh) -> NDArray[np.int64]:
    """(c,) the corner after each one in its polygon."""
    after = np.arange(1, len(mesh.face_vertices) + 1)
    after[mesh.face_offsets[1:] - 1] = mesh.face_offsets[:-1]
    return after


def inner_facets(mesh, shape: Shape) -> NDArray[np.bool_]:
    """(f,) every vertex of the facet lies inside the solid."""
    inside = shape.inside(mesh.vertices)
    return np.logical_and.reduceat(inside[mesh.face_vertices], mesh.face_offsets[:-1])


def selected_inner(medial, analysis) -> set[tuple[int, int]]:
    """The Delaunay edges of the inner facets that an analysis selects."""
    chosen = analysis.select(side=medial.Side.INNER)
    return set(map(tuple, analysis.edges[chosen].tolist()))


def jaccard(a: set, b: set) -> float:
    """The share that two sets have in common."""
    return len(a & b) / len(a | b)


def keep(mesh, facets: NDArray[np.bool_]) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """face_offsets and face_vertices of some facets."""
    sizes = np.diff(mesh.face_offsets)
    return np.concatenate(([0], np.cumsum(sizes[facets]))), mesh.face_vertices[
        np.repeat(facets, sizes)
    ]


def fan_triangles(vertices: Array, offsets: NDArray, corners: NDArray) -> Array:
    """(m, 3, 3) all convex polygons cut into fans."""
    sizes = np.diff(offsets)
    first = np.repeat(offsets[:-1], sizes - 2)
    step = np.arange(len(first)) - np.repeat(np.cumsum(sizes - 2) - (sizes - 2), sizes - 2)
    return vertices[
        np.column_stack((corners[first], corners[first + step + 1], corners[first + step + 2]))
    ]


def errors(
    mesh, shape: Shape, points: int = 20000, axis_points: int = 4000, seed: int = 0
) -> Errors:
    """Two-sided distances of the inner facets."""
    offsets, corners = keep(mesh, inner_facets(mesh, shape))
    triangles = fan_triangles(mesh.vertices, offsets, corners)
    return errors_of(triangles, shape, points, axis_points, seed)


def errors_of(
    triangles: Array, shape: Shape, points: int = 20000, axis_points: int = 4000, seed: int = 0
) -> Errors:
    """Two-sided distances of (m, 3, 3) triangles."""
    output = distance.points_on_triangles(triangles, points, np.random.default_rng(seed))
    to_truth = shape.axis_distance(output)
    truth, rim = shape.axis_points(axis_points, seed), shape.rim_points(axis_points // 4)
    to_output = distance.to_triangles(np.concatenate((truth, rim)), triangles)
    quantile = np.quantile(to_truth, 0.99)
    return Errors(
        to_truth.mean(), quantile, to_truth.max(), to_output[: len(truth)].mean(), to_output.max()
    )


def spacing(study, points: Array) -> float:
    """h: median over the samples of the largest circumradius in the umbrella."""
    offsets, triangles = study.umbrellas(points)
    p, a, b = (points[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(a - p, b - p), axis=1)
    sides = [np.linalg.norm(x, axis=1) for x in (a - p, b - p, a - b)]
    return float(
        np.median(np.maximum.reduceat(sides[0] * sides[1] * sides[2] / (2 * area), offsets[:-1]))
    )
