# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads a file as a shape, the input of the method: points, triangles, normals."""

from __future__ import annotations

import os

from ..axis.polygon_triangles import polygon_triangles
from ..machine.memory_limit import MemoryLimit
from ..settings import AboveLimit
from ..shape.shape import Shape
from .numpy_arrays import points_of_cloud
from .read import import_points


def read_shape(
    path: str | os.PathLike, limit: MemoryLimit | None = None
) -> tuple[Shape, tuple[str, ...]]:
    """Read a shape from a file; return it with one warning for each part of the file that was left out.

    Parameters
    ----------
    path : path of the file
    limit : MemoryLimit, optional
        The memory that the analysis may need. A cloud that needs more, and must not be thinned, is not unpacked.
    """
    if limit is not None and limit.above_limit is AboveLimit.REFUSE:
        limit.used(faces=False).check(points_of_cloud(path))
    found = import_points(path)
    triangles = polygon_triangles(found.vertices, found.face_offsets, found.face_vertices)
    shape = Shape(found.vertices, triangles, found.normals, single=found.single)
    return shape, found.warnings
