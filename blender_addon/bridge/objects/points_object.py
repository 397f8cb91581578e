# SPDX-License-Identifier: GPL-3.0-or-later
"""Points from a file -> a mesh object, with faces and normals where the file has them."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
from mathutils import Matrix

from ...core.errors import InvalidInputError
from ...core.files.imported_points import ImportedPoints
from ...core.files.rounding import rounding_warning
from ...core.small_matrices import times
from ..mesh.attributes import add_normals
from ..mesh.write_mesh import new_mesh


def new_points(
    found: ImportedPoints, name: str, turn: Matrix, scale: float
) -> tuple[bpy.types.Object, tuple[str, ...]]:
    """A new object at the origin, in the active collection, and warnings about it.

    `turn`, a (3, 3) rotation, is applied to points and normals, and `scale` to points. Raises InvalidInputError where
    coordinates are too large for Blender; then nothing is made.
    """
    placed = _placed(found, np.array(turn), scale)
    lost = rounding_warning(placed.vertices)
    mesh = new_mesh(placed, name)
    try:
        if placed.normals is not None:
            add_normals(mesh.attributes, placed.normals)
        mesh.validate(clean_customdata=False)  # files may hold faces that would crash Blender
    except BaseException:
        bpy.data.meshes.remove(mesh)
        raise
    removed = placed.faces - len(mesh.polygons)
    dropped = (
        f"Left out faces that repeat a corner or another face: {removed:,}" if removed else None
    )
    warnings = (*found.warnings, *filter(None, (dropped, lost)))
    return _link(bpy.data.objects.new(name, mesh)), warnings


def _placed(found: ImportedPoints, turn: np.ndarray, scale: float) -> ImportedPoints:
    vertices = scale * times(found.vertices, turn)
    largest, limit = np.abs(vertices).max(), np.finfo(np.float32).max
    if largest > limit:
        raise InvalidInputError(
            f"Expected coordinates below {limit:.3g}, which Blender can hold, found {largest:.3g}; "
            "choose a smaller scale"
        )
    normals = None if found.normals is None else times(found.normals, turn)
    return replace(found, vertices=vertices, normals=normals)


def _link(thing: bpy.types.Object) -> bpy.types.Object:
    """Into the active collection, or the scene's own where that belongs to another file."""
    active = bpy.context.collection
    collection = active if active.library is None else bpy.context.scene.collection
    collection.objects.link(thing)
    return thing
