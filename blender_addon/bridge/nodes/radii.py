# SPDX-License-Identifier: GPL-3.0-or-later
"""The part that *Balls* and *Rebuild* share: the vertices of an axis, and radii that an artist may change."""

from __future__ import annotations

import bpy

from ..mesh.attributes import RADIUS
from .tree import Tree


def points_with_radii(
    tree: Tree, merge: bpy.types.NodeSocket, axis: bpy.types.NodeSocket | None = None
) -> tuple[bpy.types.NodeSocket, bpy.types.NodeSocket]:
    """Return (the points of the axis, their radii), with the inputs *Factor*, *Offset* and *Min Radius*.

    Of vertices closer than `merge` one stays. A radius times the factor plus the offset is a thicker or thinner solid;
    where that is nothing, there is no ball. `axis` is the mesh if that is not the geometry of the group.
    """
    factor = tree.number("Factor", 1.0, "Radii are multiplied by this")
    offset = tree.number(
        "Offset", 0.0, "Radii grow by this; negative: they shrink", "DISTANCE", least=-1e30
    )
    least = tree.number("Min Radius", 0.0, "Without balls that were smaller than this", "DISTANCE")
    original = tree.attribute(RADIUS.name)
    radius = tree.math("MULTIPLY_ADD", original, factor, offset)
    small = tree.compare("LESS_THAN", original, least)
    nothing = tree.compare("LESS_EQUAL", radius, 0.0)
    kept = tree.node(
        "GeometryNodeDeleteGeometry",
        tree.geometry if axis is None else axis,
        tree.logic("OR", small, nothing),
        domain="POINT",
        mode="ALL",
    )
    points = tree.node("GeometryNodeMeshToPoints", named={"Mesh": kept})
    return tree.node(
        "GeometryNodeMergeByDistance", named={"Geometry": points, "Distance": merge}
    ), radius
