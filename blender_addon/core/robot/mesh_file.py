# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes that a robot names."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..files.read_shape import read_shape
from ..machine.memory_limit import MemoryLimit
from .primitive_meshes import Mesh


def mesh_of_file(
    path: Path,
    scale: Floats,
    limit: MemoryLimit | None,
    moved: Callable[[Floats], Floats] = lambda points: points,
) -> Mesh:
    """Return the mesh of a file, moved and then scaled along the axes; a mirrored one keeps its faces outward."""
    found, _ = read_shape(path, limit)
    triangles = found.triangles if scale.prod() > 0.0 else found.triangles[:, ::-1]
    return moved(found.points) * scale, np.ascontiguousarray(triangles)
