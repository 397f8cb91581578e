# SPDX-License-Identifier: GPL-3.0-or-later
"""The ends that an artist chose: vertices that are selected on the source."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays import Floats
from ...core.curves.spread import groups_of
from ...core.errors import InvalidInputError
from ...core.shape.shape import Shape
from ..mesh.mesh_arrays import read_edges
from .skeleton_object import rows_of_vertices


def selected_ends(source: bpy.types.Object, shape: Shape) -> Floats:
    """Return an end for each connected group of selected vertices, (e, 3): their mean, in the space of the shape.

    Raises InvalidInputError where fewer than two groups are selected, or the source is no mesh.
    """
    if source.type != "MESH":
        raise InvalidInputError(
            f"Expected a mesh with selected vertices, found '{source.name}', which is none; turn Selected Ends off"
        )
    mesh = source.data
    chosen = np.zeros(len(mesh.vertices), bool)
    mesh.vertices.foreach_get("select", chosen)
    rows = np.flatnonzero(chosen)
    group = groups_of(rows, read_edges(mesh))
    count = int(group.max(initial=-1)) + 1
    if count < 2:
        raise InvalidInputError(
            f"Expected vertices selected at two or more ends, found {count} connected groups on '{source.name}'; "
            "select a vertex at each end in Edit Mode"
        )
    places = shape.points[rows_of_vertices(source, shape)[rows]]
    size = np.bincount(group)
    return np.column_stack([np.bincount(group, places[:, k]) / size for k in range(3)])
