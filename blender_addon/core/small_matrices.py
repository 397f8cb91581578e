# SPDX-License-Identifier: GPL-3.0-or-later
"""Products and decompositions of small matrices in one fixed order of additions.

BLAS and LAPACK choose their order by the processor, so the last bits of NumPy's products of matrices differ from
machine to machine. Results depend on the functions below instead, which multiply, add, divide and take square roots
only.
"""

from __future__ import annotations

import math
import sys

import numpy as np
from numpy.typing import NDArray

from .arrays import Floats

_MOST_SWEEPS = 40  # they converge in fewer than ten


def dot(a: Floats, b: Floats) -> Floats:
    """Return the products along the last axis, (...)."""
    if a.shape[-1] == 3 == b.shape[-1]:  # five times as fast as a sum over a short axis
        x, y, z = (a[..., k] * b[..., k] for k in range(3))
        return np.asarray(x + y + z)
    return np.asarray((a * b).sum(axis=-1))


def summed(rows: NDArray[np.integer], values: Floats, count: int) -> Floats:
    """Return the sums, (count, ...), of the values, (*rows.shape, ...), of each row, added in their order.

    NumPy before 1.25 takes fifteen times as long for `add.at`, which does the same.
    """
    tail = values.shape[rows.ndim :]
    columns = np.broadcast_to(values, (*rows.shape, *tail)).reshape(rows.size, math.prod(tail)).T
    sums = [np.bincount(rows.ravel(), column, count) for column in columns]
    return np.asarray(np.stack(sums, axis=-1).reshape(count, *tail), np.float64)


def length_of(vector: Floats) -> float:
    """Return the length of one vector; tables count as one, too."""
    numbers = vector.ravel()
    return math.sqrt(float(dot(numbers, numbers)))


def times(points: Floats, matrix: Floats) -> Floats:
    """Return each of the points, (..., 3), moved by a matrix, (m, 3): `points @ matrix.T`."""
    x, y, z = (points[..., k, None] * matrix[:, k] for k in range(3))
    return np.asarray(x + y + z)


def placed(points: Floats, frame: Floats) -> Floats:
    """Return points, (..., 3), in the space to which a transform, (3, 4) or (4, 4), takes them."""
    return times(points, frame[:3, :3]) + frame[:3, 3]


def determinant(matrix: Floats) -> float:
    """Return the determinant of a (3, 3) matrix."""
    return float(dot(matrix[0], np.cross(matrix[1], matrix[2])))


def inverse(matrix: Floats) -> Floats:
    """Return the inverse of a (3, 3) matrix that has one."""
    cofactors = np.cross(matrix[[1, 2, 0]], matrix[[2, 0, 1]])
    return cofactors.T / float(dot(matrix[0], cofactors[0]))


def stretches(rows: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the singular values of a matrix, (n, 3), by one-sided Jacobi rotations (Hestenes 1958).

    Returns
    -------
    size : (3,) float64
        Descending.
    direction : (3, 3) float64
        Unit rows, perpendicular to each other: the right singular vectors.
    image : (3, n) float64
        `rows @ direction[i]`, perpendicular to each other, `size[i]` long.
    """
    largest = float(np.abs(rows).max(initial=0.0))
    exponent = math.frexp(largest)[1]
    image, direction = np.ldexp(rows.T, -exponent), np.identity(3)
    for _ in range(_MOST_SWEEPS):
        if not _turned(image, direction):
            break
    size = np.array([length_of(row) for row in image])
    order = np.argsort(-size, kind="stable")
    return np.ldexp(size[order], exponent), direction[order], np.ldexp(image[order], exponent)


def _turned(image: Floats, direction: Floats) -> bool:
    """Make each two of the rows perpendicular, one pair after the other; return whether one was not."""
    turned = False
    for p, q in ((0, 1), (0, 2), (1, 2)):
        (a, b), both = (length_of(image[p]), length_of(image[q])), float(dot(image[p], image[q]))
        rounding = 8 * sys.float_info.epsilon
        if abs(both) <= rounding * a * b or min(a, b) <= rounding * max(a, b):
            continue
        half = (b - a) * (b + a) / (2.0 * both)
        tangent = math.copysign(1.0, half) / (abs(half) + math.sqrt(1.0 + half * half))
        cosine = 1.0 / math.sqrt(1.0 + tangent * tangent)
        sine = cosine * tangent
        for table in (image, direction):
            table[p], table[q] = (
                cosine * table[p] - sine * table[q],
                sine * table[p] + cosine * table[q],
            )
        turned = True
    return turned


def shortest_solutions(squares: Floats, wanted: Floats, cutoff: float) -> Floats:
    """Return the shortest x that each matrix turns into the wanted vector, (n, 3), for many symmetric matrices.

    Parameters
    ----------
    squares : (n, 3, 3) float64
        Without negative eigenvalues. One below `cutoff` times the largest of its matrix counts as zero.
    wanted : (n, 3) float64
    """
    turning, directions = squares.copy(), np.tile(np.identity(3), (len(squares), 1, 1))
    for _ in range(_MOST_SWEEPS):
        turned = [_turned_all(turning, directions, p, q) for p, q in ((0, 1), (0, 2), (1, 2))]
        if not any(turned):
            break
    values = np.diagonal(turning, axis1=1, axis2=2)
    counts = values > cutoff * np.maximum(values.max(axis=1), np.finfo(float).tiny)[:, None]
    inverse = np.where(counts, 1.0 / np.where(counts, values, 1.0), 0.0)
    along = dot(directions, wanted[:, None]) * inverse
    return dot(directions.swapaxes(1, 2), along[:, None])


def _turned_all(matrices: Floats, directions: Floats, p: int, q: int) -> bool:
    """Make entry (p, q) of each symmetric matrix zero by a rotation (Jacobi); return whether one was not."""
    both, first, second = matrices[:, p, q], matrices[:, p, p], matrices[:, q, q]
    small = np.abs(both) <= sys.float_info.epsilon * (np.abs(first) + np.abs(second))
    half = (second - first) / (2.0 * np.where(small, 1.0, both))
    tangent = np.copysign(1.0, half) / (np.abs(half) + np.sqrt(1.0 + half * half))
    tangent[small] = 0.0
    cosine = (1.0 / np.sqrt(1.0 + tangent * tangent))[:, None]
    sine = cosine * tangent[:, None]
    # The rows of the matrices, their columns, and the rows of the directions.
    for table in (matrices, matrices.swapaxes(1, 2), directions):
        row = table[:, p].copy()
        table[:, p] = cosine * row - sine * table[:, q]
        table[:, q] = sine * row + cosine * table[:, q]
    matrices[:, p, q] = matrices[:, q, p] = 0.0
    return not small.all()
