# SPDX-License-Identifier: GPL-3.0-or-later
"""Does what is installed here compute a medial axis that is known, and does Blender take it?"""

from __future__ import annotations

import bpy
import numpy as np

from ..core.axis.known_box import Check, checks_of, compute_box
from ..core.axis.medial_axis import MedialAxis
from ..core.errors import MedialAxisError
from .mesh.attributes import RADIUS, read_attribute
from .mesh.write_mesh import new_axis_mesh


def self_test() -> list[Check]:
    """Every check; what is made for it is removed again."""
    try:
        box = compute_box()
        return [*checks_of(box), _check_mesh(box.axis)]
    except MedialAxisError as error:
        return [Check(False, str(error))]


def _check_mesh(axis: MedialAxis) -> Check:
    mesh = new_axis_mesh(axis, "Medial Axis Self-Test")
    try:
        radius = read_attribute(mesh.attributes, RADIUS.name, RADIUS.type, RADIUS.domain)
        facets = len(mesh.polygons)
        same = facets == axis.facets and np.array_equal(radius, axis.radius.astype(np.float32))
        return Check(same, f"Blender has a mesh of {facets:,} faces with these radii")
    finally:
        bpy.data.meshes.remove(mesh)
