# SPDX-License-Identifier: GPL-3.0-or-later
"""The distance between two closed surfaces, measured in both directions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..errors import InvalidInputError
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..shape.shape import Shape
from ..small_matrices import length_of

SAMPLES = 100_000  # the number of samples of each surface, besides its vertices
# Powers of the plastic number: the fractional parts of their multiples fill the square evenly (Roberts' R2 sequence).
_R2 = (0.7548776662466927, 0.5698402909980532)


@dataclass(frozen=True)
class SolidDifference:
    """The difference of two solids."""

    # The distance of a point of one surface to the other, as a share of the diagonal of the first solid: the mean by
    # area, and the largest. The larger value of both directions counts.
    mean: float
    largest: float
    volume: float  # The volume of the second solid as a multiple of the first


@dataclass(frozen=True)
class PointDifference:
    """The difference between a surface and a solid."""

    # Distances as shares of the diagonal of the surface: the mean distance of its points to the surface of the solid,
    # by area, and the largest distance in both directions
    mean: float
    largest: float


def solid_difference(first: Shape, second: Shape) -> SolidDifference:
    """Compare two surfaces in the same coordinates; only `points` and `triangles` are used.

    Raises
    ------
    InvalidInputError
        One has no faces, or the first encloses nothing.
    NativeModuleError, OutOfMemoryError
    """
    for shape in (first, second):
        if not len(shape.triangles):
            raise InvalidInputError("Expected two surfaces with faces, found one without")
    if first.volume == 0.0:
        raise InvalidInputError("Expected a first solid with a volume, found one without")
    there, back = _distances(first, second), _distances(second, first)
    diagonal = length_of(np.ptp(first.points[first.triangles.ravel()], axis=0))
    return SolidDifference(
        mean=max(there[:SAMPLES].mean(), back[:SAMPLES].mean()) / diagonal,
        largest=max(there.max(), back.max()) / diagonal,
        volume=second.volume / first.volume,
    )


def difference_of_points(
    shape: Shape,
    points: Floats,
    signed: Callable[[Floats], Floats],
    progress: Progress | None = None,
) -> PointDifference:
    """Compare a surface with a solid that is given by points on its surface and signed distances.

    Parameters
    ----------
    shape : Shape
        The surface; only `points` and `triangles` are used.
    points : (k, 3) float64
        Points all over the surface of the solid.
    signed : callable
        Maps (q, 3) queries to (q,) distances from the solid, which are negative inside and may be too small there.
    progress : Progress, optional

    Raises
    ------
    InvalidInputError
        The surface has no faces.
    NativeModuleError, OutOfMemoryError, Cancelled
    """
    if not len(shape.triangles):
        raise InvalidInputError("Expected a surface with faces, found one without")
    used = shape.points[np.unique(shape.triangles)]
    queries = np.concatenate([_samples(shape), used])
    there = np.array(signed(queries))
    inside = there < 0
    with own_errors() as module:
        nearest = np.asarray(module.nearest(points, queries[inside]))
        part = progress and progress.part()
        back = np.asarray(
            module.TriangleTree(shape.points, shape.triangles).distances(points, progress=part)
        )
    there[inside] = np.linalg.norm(points[nearest] - queries[inside], axis=1)
    diagonal = length_of(np.ptp(used, axis=0))
    return PointDifference(
        mean=float(there[:SAMPLES].mean()) / diagonal,
        largest=float(max(there.max(), back.max())) / diagonal,
    )


def _distances(of: Shape, to: Shape) -> Floats:
    """(SAMPLES + v,) distances from samples of one surface, and then from its vertices, to another surface."""
    used = np.unique(of.triangles)
    queries = np.concatenate([_samples(of), of.points[used]])
    with own_errors() as module:
        return np.asarray(module.TriangleTree(to.points, to.triangles).distances(queries))


def _samples(shape: Shape) -> Floats:
    """(SAMPLES, 3) points of a surface, evenly by area."""
    a, b, c = (shape.points[shape.triangles[:, corner]] for corner in range(3))
    until = np.cumsum(np.linalg.norm(np.cross(b - a, c - a), axis=1))
    number = np.arange(SAMPLES)
    row = np.searchsorted(until, (number + 0.5) / SAMPLES * until[-1])
    row = np.minimum(row, len(until) - 1)
    s, t = ((number * step) % 1.0 for step in _R2)
    root = np.sqrt(s)[:, None]
    share = t[:, None]
    return (1 - root) * a[row] + root * (1 - share) * b[row] + root * share * c[row]
