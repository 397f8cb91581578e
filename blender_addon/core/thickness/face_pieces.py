# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of a shape cut into pieces about as large as the triangles between samples."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Longs
from ..samples.walls import Walls
from ..shape.shape import Shape
from ..shape.triangles import unit_normals
from ..small_matrices import times


def face_pieces(shape: Shape, some: NDArray[np.intp], places: Walls) -> tuple[Floats, Ints, Ints]:
    """Cut some faces into congruent pieces, each about as large as an equilateral triangle between samples.

    The (k,) faces are distinct, and each has a place, where the spacing of the samples is known. Returns (n, 3) points,
    (p, 3) triangles that turn as their faces do, and (p,) the face of each.
    """
    cuts = _cuts(shape, some, places)
    points, triangles, of_pieces, count = [], [], [], 0
    for cut in np.unique(cuts).tolist():
        group = some[cuts == cut]
        shares, pieces = _lattice(cut)
        corners = shape.points[shape.triangles[group]].swapaxes(1, 2)
        points.append(times(corners, shares).swapaxes(1, 2).reshape(-1, 3))
        start = count + len(shares) * np.arange(len(group))
        triangles.append((pieces + start[:, None, None]).reshape(-1, 3))
        of_pieces.append(np.repeat(group, len(pieces)))
        count += len(points[-1])
    return (
        np.concatenate(points),
        np.concatenate(triangles).astype(np.int32),
        np.concatenate(of_pieces).astype(np.int32),
    )


def _cuts(shape: Shape, faces: NDArray[np.intp], places: Walls) -> Longs:
    """(m,) the number of parts into which each side of a face is cut."""
    area = unit_normals(shape.points[shape.triangles[faces]])[1] / 2
    count = len(shape.triangles)
    total = np.bincount(places.faces, places.spacing, count)
    spacing = total[faces] / np.bincount(places.faces, minlength=count)[faces]
    return np.maximum(1, np.ceil(np.sqrt(area / (math.sqrt(3.0) / 4)) / spacing)).astype(np.int64)


def _lattice(cut: int) -> tuple[Floats, Longs]:
    """(n, 3) shares of the corners of a triangle at the points of a lattice in it, and (cut^2, 3) its pieces."""
    i, j = np.nonzero(np.add.outer(np.arange(cut + 1), np.arange(cut + 1)) <= cut)
    row = np.full((cut + 2, cut + 2), -1)
    row[i, j] = np.arange(len(i))
    below, above = i + j < cut, i + j < cut - 1
    up = np.stack((row[i, j], row[i + 1, j], row[i, j + 1]), axis=1)[below]
    down = np.stack((row[i + 1, j], row[i + 1, j + 1], row[i, j + 1]), axis=1)[above]
    shares = np.stack((cut - i - j, i, j), axis=1) / cut
    return shares, np.concatenate((up, down))
