"""A file as the shape that the method takes: points, triangles, normals."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .import_points import import_points
from .triangulate import triangulate

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Shape:
    """What a file is to the method.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
    normals : (n, 3) float64 or None
    frame : (4, 4) float64
        From `points` to the world.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    normals: NDArray[np.float64] | None
    frame: NDArray[np.float64]


def read_shape(path: str | os.PathLike) -> tuple[Shape, tuple[str, ...]]:
    """What a file holds, and what was left in it, a sentence each.

    Raises
    ------
    ReadError, OutOfMemoryError
    """
    found = import_points(path)
    triangles = triangulate(found.vertices, found.face_offsets, found.face_vertices, convex=False)
    return Shape(found.vertices, triangles, found.normals, np.identity(4)), found.warnings
