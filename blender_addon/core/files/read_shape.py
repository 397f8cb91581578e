# SPDX-License-Identifier: GPL-3.0-or-later
"""A file as the shape that the method takes: points, triangles, normals."""

from __future__ import annotations

import os

from ..axis.polygon_triangles import polygon_triangles
from ..axis.shape import Shape
from .read import import_points


def read_shape(path: str | os.PathLike) -> tuple[Shape, tuple[str, ...]]:
    """What a file holds, and what was left in it, a sentence each.

    Raises
    ------
    ReadError, NativeModuleError, OutOfMemoryError
    """
    found = import_points(path)
    triangles = polygon_triangles(found.vertices, found.face_offsets, found.face_vertices)
    return Shape(found.vertices, triangles, found.normals), found.warnings
